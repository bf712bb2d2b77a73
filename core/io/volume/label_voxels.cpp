#include "io/volume/label_voxels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "io/bytes/header_text.h"

namespace voxtet {
namespace {

constexpr double kLargestLabel = 65535;
constexpr std::size_t kVoxelBlock = std::size_t{1} << 16;

std::string voxel_name(const VoxelLayout& layout, std::uint64_t value_index) {
  const auto layers = static_cast<std::uint64_t>(layout.layers);
  const auto nx = static_cast<std::uint64_t>(layout.size[0]), ny = static_cast<std::uint64_t>(layout.size[1]);
  const std::uint64_t voxel = value_index / layers;
  std::string name = "voxel (" + std::to_string(voxel % nx) + ", " + std::to_string(voxel / nx % ny) + ", " +
                     std::to_string(voxel / nx / ny) + ")";
  if (layers > 1) name += " of layer " + std::to_string(value_index % layers);
  return name;
}

Error bad_value(const VoxelLayout& layout, std::uint64_t value_index, const std::string& value) {
  return bad_input(layout.stage, voxel_name(layout, value_index) + " has the value " + value +
                                     "; expected labels, whole numbers from 0 to 65535");
}

template <class T>
std::string text_of(T value) {
  if constexpr (std::is_floating_point_v<T>)
    return number_text(value);
  else
    return std::to_string(value);
}

/// Decodes `count` values into `out`; returns how many were labels before the first that is none.
template <class T>
std::size_t decode(const std::uint8_t* in, std::size_t count, const VoxelLayout& layout, Label* out) {
  const bool scaled = layout.slope != 1 || layout.inter != 0;
  for (std::size_t n = 0; n < count; ++n) {
    const T stored = load_value<T>(in + n * sizeof(T), layout.big_endian);
    if (scaled) {
      const double value = static_cast<double>(stored) * layout.slope + layout.inter;
      const double whole = std::nearbyint(value);
      // Written so that NaN fails.
      if (!(std::abs(value - whole) <= 1e-6 * (1 + std::abs(value))) || whole < 0 || whole > kLargestLabel)
        return n;
      out[n] = static_cast<Label>(whole);
    } else if constexpr (std::is_floating_point_v<T>) {
      if (!(stored >= 0 && stored <= static_cast<T>(kLargestLabel)) || stored != std::trunc(stored)) return n;
      out[n] = static_cast<Label>(stored);
    } else {
      if constexpr (std::is_signed_v<T>)
        if (stored < 0) return n;
      if constexpr (sizeof(T) > sizeof(Label))
        if (stored > static_cast<T>(65535)) return n;
      out[n] = static_cast<Label>(stored);
    }
  }
  return count;
}

template <class T>
std::size_t decode(const std::uint8_t* in, std::size_t count, const VoxelLayout& layout, float* out) {
  for (std::size_t n = 0; n < count; ++n)
    out[n] = static_cast<float>(static_cast<double>(load_value<T>(in + n * sizeof(T), layout.big_endian)) *
                                    layout.slope +
                                layout.inter);
  return count;
}

template <class T>
std::string value_text(const std::uint8_t* at, const VoxelLayout& layout) {
  const T stored = load_value<T>(at, layout.big_endian);
  if (layout.slope == 1 && layout.inter == 0) return text_of(stored);
  return number_text(static_cast<double>(stored) * layout.slope + layout.inter);
}

/// Calls `visit` with a value of the C++ type that `type` stands for.
template <class Visit>
auto with_type(VoxelType type, Visit&& visit) {
  switch (type) {
    case VoxelType::kInt8: return visit(std::int8_t{});
    case VoxelType::kUint8: return visit(std::uint8_t{});
    case VoxelType::kInt16: return visit(std::int16_t{});
    case VoxelType::kUint16: return visit(std::uint16_t{});
    case VoxelType::kInt32: return visit(std::int32_t{});
    case VoxelType::kUint32: return visit(std::uint32_t{});
    case VoxelType::kInt64: return visit(std::int64_t{});
    case VoxelType::kUint64: return visit(std::uint64_t{});
    case VoxelType::kFloat32: return visit(float{});
    case VoxelType::kFloat64: break;
  }
  return visit(double{});
}

Error wrong_length(const VoxelLayout& layout, const std::string& found, std::uint64_t expected) {
  return bad_input(layout.stage,
                   "the voxel data " + found + "; expected " + std::to_string(expected) + " bytes for " +
                       std::to_string(layout.size[0]) + " x " + std::to_string(layout.size[1]) + " x " +
                       std::to_string(layout.size[2]) + " voxels" +
                       (layout.layers > 1 ? " of " + std::to_string(layout.layers) + " layers" : ""));
}

template <class Value>
Result<std::vector<Value>> read_values(ByteSource& source, const VoxelLayout& layout) {
  const std::uint64_t count = layout.value_count();
  const std::size_t width = bytes_of(layout.type);
  const std::uint64_t expected = count * width;
  if (expected > source.at_most_left())
    return wrong_length(layout,
                        (source.compressed() ? "inflate to at most " : "are truncated: they have ") +
                            std::to_string(source.at_most_left()) + " bytes",
                        expected);

  std::vector<Value> values(static_cast<std::size_t>(count));
  std::vector<std::uint8_t> block(static_cast<std::size_t>(std::min<std::uint64_t>(expected, kVoxelBlock)));
  std::uint64_t done = 0;
  while (done < count) {
    const auto batch = static_cast<std::size_t>(std::min<std::uint64_t>(count - done, block.size() / width));
    Result<std::size_t> got = source.read({block.data(), batch * width});
    if (!got) return got.error();
    if (*got < batch * width)
      return wrong_length(
          layout, "are truncated: they have " + std::to_string(done * width + *got) + " bytes", expected);
    Value* out = values.data() + done;
    const std::size_t good = with_type(
        layout.type, [&](auto value) { return decode<decltype(value)>(block.data(), batch, layout, out); });
    if (good < batch) {
      const std::string text = with_type(layout.type, [&](auto value) {
        return value_text<decltype(value)>(block.data() + good * width, layout);
      });
      return bad_value(layout, done + good, text);
    }
    done += batch;
  }
  std::uint8_t extra = 0;
  Result<std::size_t> got = source.read({&extra, 1});
  if (!got) return got.error();
  if (*got > 0) {
    const std::string more =
        source.compressed() ? "go on" : "go on for " + std::to_string(1 + source.at_most_left()) + " bytes";
    return wrong_length(layout, more + " after the last voxel", expected);
  }
  return values;
}

}  // namespace

std::size_t bytes_of(VoxelType type) {
  return with_type(type, [](auto value) { return sizeof(value); });
}

Status check_extents(const VoxelLayout& layout, const std::string& field) {
  std::uint64_t bytes = std::max(bytes_of(layout.type), sizeof(Label));
  const std::uint64_t most = std::numeric_limits<std::ptrdiff_t>::max();
  for (const std::int64_t extent : {layout.layers, layout.size[0], layout.size[1], layout.size[2]}) {
    if (extent < 1 || extent > std::numeric_limits<std::int32_t>::max())
      return bad_input(layout.stage,
                       field + " holds the extent " + std::to_string(extent) + "; expected 1 to 2147483647");
    if (bytes > most / static_cast<std::uint64_t>(extent))
      return bad_input(layout.stage, field + " asks for more voxels than memory can hold");
    bytes *= static_cast<std::uint64_t>(extent);
  }
  return std::monostate{};
}

Result<std::vector<Label>> read_labels(ByteSource& source, const VoxelLayout& layout) {
  return read_values<Label>(source, layout);
}

Result<std::vector<float>> read_scalars(ByteSource& source, const VoxelLayout& layout) {
  return read_values<float>(source, layout);
}

Result<std::vector<Label>> read_text_labels(std::span<const std::uint8_t> text, const VoxelLayout& layout) {
  const std::uint64_t count = layout.value_count();
  if (count > text.size() / 2)
    return bad_input(layout.stage, "the text data are truncated: " + std::to_string(text.size()) +
                                       " characters cannot hold " + std::to_string(count) +
                                       " numbers with white space after each");
  std::vector<Label> labels;
  labels.reserve(static_cast<std::size_t>(count));
  std::size_t at = 0;
  while (true) {
    while (at < text.size() && is_space(text[at])) ++at;
    if (at == text.size()) break;
    const std::size_t begin = at;
    while (at < text.size() && !is_space(text[at])) ++at;
    const std::string token(text.begin() + static_cast<std::ptrdiff_t>(begin),
                            text.begin() + static_cast<std::ptrdiff_t>(std::min(at, begin + 40)));
    if (labels.size() == count)
      return bad_input(layout.stage, "the text data go on after the last voxel with \"" + token +
                                         "\"; expected " + std::to_string(count) + " numbers");
    if (at == text.size())
      return bad_input(layout.stage, "the text data end inside the number \"" + token +
                                         "\"; expected white space after the last one");
    const std::optional<double> value = parse_double(token);
    if (!value || !(*value >= 0 && *value <= kLargestLabel) || *value != std::trunc(*value))
      return bad_value(layout, labels.size(), "\"" + token + "\"");
    labels.push_back(static_cast<Label>(*value));
  }
  if (labels.size() < count)
    return bad_input(layout.stage, "the text data are truncated: they have " + std::to_string(labels.size()) +
                                       " numbers; expected " + std::to_string(count));
  return labels;
}

Status check_affine(const std::string& stage, const std::string& field, const Eigen::Matrix4d& index_to_mm) {
  if (!index_to_mm.allFinite()) return bad_input(stage, field + " holds a number that is not finite");
  const Eigen::Matrix3d linear = index_to_mm.topLeftCorner<3, 3>();
  const Eigen::Vector3d spacing = linear.colwise().norm().transpose();
  for (int d = 0; d < 3; ++d)
    if (!(spacing[d] >= 1e-6 && spacing[d] <= 1e6))
      return bad_input(stage, field + " gives a voxel spacing of " + number_text(spacing[d]) +
                                  " mm along axis " + std::to_string(d) + "; expected 1e-6 to 1e6 mm");
  const Eigen::Matrix3d unit = linear * spacing.cwiseInverse().asDiagonal();
  if (std::abs(unit.determinant()) < 1e-6)
    return bad_input(stage, field + " is singular: the three voxel axes lie in one plane");
  return std::monostate{};
}

LabelVolume make_volume(const VoxelLayout& layout, const Eigen::Matrix4d& index_to_mm,
                        std::vector<Label> labels) {
  LabelVolume volume;
  for (std::size_t d = 0; d < 3; ++d) volume.size[d] = static_cast<int>(layout.size[d]);
  volume.index_to_mm = index_to_mm;
  volume.labels = std::move(labels);
  return volume;
}

}  // namespace voxtet
