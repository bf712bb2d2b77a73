#include "io/volume/voxels/voxel_layout.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/bytes/header_text.h"

namespace voxtet {

std::size_t bytes_of(VoxelType type) {
  switch (type) {
    case VoxelType::kInt8:
    case VoxelType::kUint8: return 1;
    case VoxelType::kInt16:
    case VoxelType::kUint16: return 2;
    case VoxelType::kInt32:
    case VoxelType::kUint32:
    case VoxelType::kFloat32: return 4;
    case VoxelType::kInt64:
    case VoxelType::kUint64:
    case VoxelType::kFloat64: break;
  }
  return 8;
}

Status check_extents(const VoxelLayout& layout, const std::string& field) {
  std::uint64_t bytes = std::max(bytes_of(layout.type), sizeof(Label));
  const std::uint64_t most = std::numeric_limits<std::ptrdiff_t>::max();
  for (const std::int64_t extent :
       {layout.layers, layout.frames, layout.size[0], layout.size[1], layout.size[2]}) {
    if (extent < 1 || extent > std::numeric_limits<std::int32_t>::max())
      return bad_input(layout.stage,
                       field + " holds the extent " + std::to_string(extent) + "; expected 1 to 2147483647");
    if (bytes > most / static_cast<std::uint64_t>(extent))
      return bad_input(layout.stage, field + " asks for more voxels than memory can hold");
    bytes *= static_cast<std::uint64_t>(extent);
  }
  return std::monostate{};
}

std::string voxel_name(const VoxelLayout& layout, std::uint64_t value_index) {
  const auto layers = static_cast<std::uint64_t>(layout.layers);
  const auto nx = static_cast<std::uint64_t>(layout.size[0]), ny = static_cast<std::uint64_t>(layout.size[1]);
  const std::uint64_t frame = value_index / (layers * layout.voxel_count());
  const std::uint64_t voxel = value_index / layers % layout.voxel_count();
  std::string name = "voxel (" + std::to_string(voxel % nx) + ", " + std::to_string(voxel / nx % ny) + ", " +
                     std::to_string(voxel / nx / ny) + ")";
  if (layers > 1) name += " of layer " + std::to_string(value_index % layers);
  if (layout.frames > 1) name += " of frame " + std::to_string(frame);
  return name;
}

Error one_slice(const std::string& stage, const std::string& field, const std::string& found) {
  return bad_input(stage, field + " is " + found +
                              ": the file holds one slice, which has no volume to be meshed; expected a "
                              "stack of slices in one file");
}

Status check_affine(const std::string& stage, const std::string& field, const Eigen::Matrix4d& index_to_mm) {
  if (!index_to_mm.allFinite()) return bad_input(stage, field + " holds a number that is not finite");
  const Eigen::Matrix3d linear = index_to_mm.topLeftCorner<3, 3>();
  const Eigen::Vector3d spacing = linear.colwise().norm().transpose();
  for (int d = 0; d < 3; ++d)
    if (!(spacing[d] >= 1e-6 && spacing[d] <= 1e6))
      return bad_input(stage, field + " gives a voxel spacing of " + number_text(spacing[d]) +
                                  " mm along axis " + std::to_string(d) +
                                  "; expected 1e-6 to 1e6 mm: wrong unit? (source.unit)");
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
