#include "io/volume/formats/read_mgh.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "io/volume/voxels/length_unit.h"
#include "io/volume/voxels/merge_frames.h"

namespace voxtet {
namespace {

constexpr const char* kMghReader = "read_mgh";
constexpr std::size_t kMghHeader = 284, kMghUsed = 90;

using MghHeader = std::array<std::uint8_t, kMghHeader>;

std::int64_t int_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  return load_value<std::int32_t>(bytes.data() + at, true);
}

std::optional<VoxelType> mgh_type(std::int64_t type) {
  switch (type) {
    case 0: return VoxelType::kUint8;
    case 1: return VoxelType::kInt32;
    case 3: return VoxelType::kFloat32;
    case 4: return VoxelType::kInt16;
    case 10: return VoxelType::kUint16;
    default: return std::nullopt;
  }
}

/// The voxels of a source that goes on behind them.
class VoxelBytes : public ByteSource {
 public:
  VoxelBytes(ByteSource& source, std::uint64_t count) : source_(source), left_(count) {}
  Result<std::size_t> read(std::span<std::uint8_t> out) override {
    Result<std::size_t> got =
        source_.read(out.first(static_cast<std::size_t>(std::min<std::uint64_t>(out.size(), left_))));
    if (got) left_ -= *got;
    return got;
  }
  std::uint64_t at_most_left() const override { return std::min(left_, source_.at_most_left()); }
  bool compressed() const override { return source_.compressed(); }

 private:
  ByteSource& source_;
  std::uint64_t left_;
};

/// To the end: damage may show in a checksum only there.
Status pass_over_rest(ByteSource& source) {
  std::array<std::uint8_t, 4096> rest;
  for (;;) {
    const Result<std::size_t> got = source.read(rest);
    if (!got) return got.error();
    if (*got < rest.size()) return std::monostate{};
  }
}

Result<VoxelLayout> layout_of(const MghHeader& bytes) {
  VoxelLayout layout;
  layout.stage = kMghReader;
  layout.big_endian = true;
  layout.size = {int_at(bytes, 4), int_at(bytes, 8), int_at(bytes, 12)};
  layout.frames = int_at(bytes, 16);
  layout.frames_said = "nframes is " + std::to_string(layout.frames);
  layout.type = *mgh_type(int_at(bytes, 20));
  if (Status good = check_extents(layout, "width, height, depth, nframes"); !good) return good.error();
  return layout;
}

Result<Eigen::Matrix4d> affine_of(const MghHeader& bytes, const VoxelLayout& layout, const Reading& reading) {
  std::array<double, 15> numbers{1, 1, 1, -1, 0, 0, 0, 0, -1, 0, 1, 0, 0, 0, 0};
  if (load_value<std::int16_t>(bytes.data() + 28, true) > 0)
    for (std::size_t n = 0; n < numbers.size(); ++n)
      numbers[n] = load_value<float>(bytes.data() + 30 + 4 * n, true);
  Eigen::Matrix4d affine = Eigen::Matrix4d::Identity();
  Eigen::Vector3d middle;
  for (int d = 0; d < 3; ++d) {
    const auto axis = static_cast<std::size_t>(d);
    for (int row = 0; row < 3; ++row)
      affine(row, d) = numbers[axis] * numbers[3 + 3 * axis + static_cast<std::size_t>(row)];
    affine(d, 3) = numbers[12 + axis];
    middle[d] = static_cast<double>(layout.size[axis]) / 2;
  }
  affine.topRightCorner<3, 1>() -= affine.topLeftCorner<3, 3>() * middle;
  affine.topRows<3>() *= mm_per_unit_of(reading.options).value_or(1);
  if (Status good = check_affine(kMghReader, "spacing, direction cosines and centre", affine); !good)
    return good.error();
  return affine;
}

}  // namespace

bool looks_like_mgh(std::span<const std::uint8_t> start) {
  if (start.size() < kMghUsed || int_at(start, 0) != 1 || !mgh_type(int_at(start, 20))) return false;
  return int_at(start, 4) > 0 && int_at(start, 8) > 0 && int_at(start, 12) > 0 && int_at(start, 16) > 0;
}

Result<LabelVolume> read_mgh(ByteSource& source, Reading& reading) {
  MghHeader bytes{};
  const Result<std::size_t> got = source.read(bytes);
  if (!got) return got.error();
  if (*got < kMghHeader)
    return bad_input(kMghReader, "the header is truncated: " + std::to_string(*got) + " bytes; expected 284");
  const Result<VoxelLayout> layout = layout_of(bytes);
  if (!layout) return layout.error();
  const Result<Eigen::Matrix4d> affine = affine_of(bytes, *layout, reading);
  if (!affine) return affine.error();
  VoxelBytes voxels(source, layout->value_count() * bytes_of(layout->type));
  Result<std::vector<Label>> labels = read_labels(
      *layout, reading, [&](ValueSink& sink) { return read_values(voxels, *layout, sink, reading); });
  if (!labels) return labels.error();
  if (Status whole = pass_over_rest(source); !whole) return whole.error();
  return make_volume(*layout, *affine, std::move(*labels));
}

}  // namespace voxtet
