#include "io/volume/coded/coded_volume.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "io/bytes/byte_source.h"
#include "io/volume/coded/binary_coder.h"
#include "io/volume/coded/coded_numbers.h"
#include "io/volume/coded/label_stream.h"
#include "io/volume/voxels/voxel_layout.h"

namespace voxtet {
namespace {

constexpr const char* kStage = "decode_volume";
constexpr std::uint8_t kVersion = 1;

/// The smallest box that holds everything but background; of no size where there is nothing.
struct VoxelBox {
  std::array<int, 3> low{}, size{};

  template <class Visit>
  void visit(const Grid& grid, Visit&& visit) const {
    std::size_t inside = 0;
    for (int k = 0; k < size[2]; ++k)
      for (int j = 0; j < size[1]; ++j)
        for (int i = 0; i < size[0]; ++i, ++inside)
          visit(grid.offset(low[0] + i, low[1] + j, low[2] + k), inside);
  }
  std::size_t voxels() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }
};

VoxelBox box_of(const LabelVolume& volume) {
  std::array<int, 3> low = volume.size, high{-1, -1, -1};
  volume.visit([&](int i, int j, int k, std::size_t at) {
    if (volume.labels[at] == kBackground) return;
    const std::array<int, 3> place{i, j, k};
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], place[d]);
      high[d] = std::max(high[d], place[d]);
    }
  });
  if (high[0] < 0) return {};
  return {low, {high[0] - low[0] + 1, high[1] - low[1] + 1, high[2] - low[2] + 1}};
}

/// Those of the volume, ascending, background first whether it is there or not.
std::vector<Label> labels_of(const LabelVolume& volume) {
  std::vector<bool> there(65536, false);
  there[kBackground] = true;
  for (const Label label : volume.labels) there[label] = true;
  std::vector<Label> labels;
  for (std::size_t label = 0; label < there.size(); ++label)
    if (there[label]) labels.push_back(static_cast<Label>(label));
  return labels;
}

/// Tells a damaged text from a whole one.
std::uint32_t checksum_of(const LabelVolume& volume) {
  std::uint32_t sum = static_cast<std::uint32_t>(crc32(0, nullptr, 0));
  const auto add = [&sum](const void* bytes, std::size_t count) {
    sum = static_cast<std::uint32_t>(crc32(sum, static_cast<const Bytef*>(bytes), static_cast<uInt>(count)));
  };
  add(volume.size.data(), sizeof volume.size);
  add(volume.index_to_mm.data(), 16 * sizeof(double));
  add(volume.labels.data(), volume.labels.size() * sizeof(Label));
  return sum;
}

Error damaged(const std::string& what) {
  return bad_input(kStage, "the coded volume is damaged: " + what);
}

/// Size, box and affine; the labels' numbers.
struct Head {
  LabelVolume volume;  ///< without labels
  VoxelBox box;
  std::vector<Label> labels;
  std::uint32_t checksum = 0;
};

Result<Head> read_head(NumberReader& in) {
  Head head;
  if (const int version = in.byte(); version != kVersion)
    return damaged("found version " + std::to_string(version) + ", expected " + std::to_string(kVersion));
  std::uint64_t voxels = 1;
  for (std::size_t d = 0; d < 3; ++d) {
    const std::uint64_t size = in.number();
    if (size < 1 || size > kMostCodedVoxels) return damaged("its size is out of range");
    voxels *= size;
    if (voxels > kMostCodedVoxels)
      return bad_input(kStage,
                       "the coded volume has more than " + std::to_string(kMostCodedVoxels) + " voxels");
    const std::uint64_t low = in.number(), box = in.number();
    if (low > size || box > size - low) return damaged("its box is out of range");
    head.volume.size[d] = static_cast<int>(size);
    head.box.low[d] = static_cast<int>(low);
    head.box.size[d] = static_cast<int>(box);
  }
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) head.volume.index_to_mm(row, column) = in.real();
  if (Status good = check_affine(kStage, "the coded volume: affine", head.volume.index_to_mm); !good)
    return good.error();
  const std::uint64_t count = in.number();
  if (count > IndexedLabels::kMostLabels) return damaged("it has too many labels");
  head.labels.push_back(kBackground);
  for (std::uint64_t n = 1; n < count; ++n) {
    const std::uint64_t label = head.labels.back() + in.number();
    if (label <= head.labels.back() || label > 65535) return damaged("its labels are out of range");
    head.labels.push_back(static_cast<Label>(label));
  }
  for (unsigned i = 0; i < 4; ++i) head.checksum |= static_cast<std::uint32_t>(in.byte()) << (8 * i);
  if (in.failed()) return damaged("it ends too early");
  return head;
}

}  // namespace

Result<Bytes> code_volume(const LabelVolume& volume) {
  if (volume.voxel_count() > kMostCodedVoxels)
    return usage_error("code_volume", "the volume has " + std::to_string(volume.voxel_count()) +
                                          " voxels, a link holds at most " +
                                          std::to_string(kMostCodedVoxels));
  const std::vector<Label> labels = labels_of(volume);
  if (labels.size() > IndexedLabels::kMostLabels)
    return usage_error("code_volume", "the volume has " + std::to_string(labels.size() - 1) +
                                          " labels, a link holds at most " +
                                          std::to_string(IndexedLabels::kMostLabels - 1));
  const VoxelBox box = box_of(volume);
  Bytes bytes{kVersion};
  for (std::size_t d = 0; d < 3; ++d)
    for (const int number : {volume.size[d], box.low[d], box.size[d]})
      put_number(bytes, static_cast<std::uint64_t>(number));
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) put_real(bytes, volume.index_to_mm(row, column));
  put_number(bytes, labels.size());
  for (std::size_t n = 1; n < labels.size(); ++n)
    put_number(bytes, static_cast<std::uint64_t>(labels[n] - labels[n - 1]));
  const std::uint32_t checksum = checksum_of(volume);
  for (unsigned i = 0; i < 4; ++i) bytes.push_back(static_cast<std::uint8_t>(checksum >> (8 * i) & 0xffU));

  std::vector<std::uint8_t> index(65536, 0);
  for (std::size_t n = 0; n < labels.size(); ++n) index[labels[n]] = static_cast<std::uint8_t>(n);
  IndexedLabels indexed{box.size, std::vector<std::uint8_t>(box.voxels())};
  box.visit(volume,
            [&](std::size_t at, std::size_t inside) { indexed.indices[inside] = index[volume.labels[at]]; });
  BinaryEncoder encoder;
  code_labels(encoder, labels.size(), indexed);
  const Bytes coded = encoder.finish();
  bytes.insert(bytes.end(), coded.begin(), coded.end());
  return bytes;
}

Result<LabelVolume> decode_volume(std::span<const std::uint8_t> bytes) {
  NumberReader in(bytes);
  Result<Head> head = read_head(in);
  if (!head) return head.error();
  LabelVolume volume = std::move(head->volume);
  IndexedLabels indexed{head->box.size, std::vector<std::uint8_t>(head->box.voxels())};
  BinaryDecoder decoder(in.rest());
  if (!code_labels(decoder, head->labels.size(), indexed)) return damaged("it ends too early");
  volume.labels.assign(volume.voxel_count(), kBackground);
  head->box.visit(volume, [&](std::size_t at, std::size_t inside) {
    volume.labels[at] = head->labels[indexed.indices[inside]];
  });
  if (checksum_of(volume) != head->checksum) return damaged("its checksum does not fit");
  return volume;
}

}  // namespace voxtet
