// How a file stores its voxels, and where they are.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/bytes/byte_source.h"
#include "types/label_volume.h"
#include "types/result.h"

namespace voxtet {

enum class VoxelType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kInt64, kUint64, kFloat32, kFloat64 };

std::size_t bytes_of(VoxelType type);

/// Extents are checked by `check_extents`, not here. A file has several layers or several frames, or neither.
struct VoxelLayout {
  std::string stage;  ///< the reader, for errors
  std::array<std::int64_t, 3> size{1, 1, 1};
  std::int64_t layers = 1;  ///< values of each voxel, one next to the other
  std::int64_t frames = 1;  ///< images, one behind the other
  std::string frames_said;  ///< where the file says that there are several: "dim[4] is 5"
  VoxelType type = VoxelType::kUint8;
  bool big_endian = false;
  double slope = 1, inter = 0;  ///< value = slope * stored + inter

  std::uint64_t voxel_count() const {
    return static_cast<std::uint64_t>(size[0]) * static_cast<std::uint64_t>(size[1]) *
           static_cast<std::uint64_t>(size[2]);
  }
  std::uint64_t value_count() const {
    return voxel_count() * static_cast<std::uint64_t>(layers) * static_cast<std::uint64_t>(frames);
  }
  /// The frame (or layer) that a value belongs to.
  std::uint64_t frame_of(std::uint64_t value_index) const {
    return layers > 1 ? value_index % static_cast<std::uint64_t>(layers) : value_index / voxel_count();
  }
  bool scaled() const { return slope != 1 || inter != 0; }
  bool whole() const { return type != VoxelType::kFloat32 && type != VoxelType::kFloat64; }
};

/// Checks that each extent is in 1..2^31-1 and that the bytes of all values fit into memory. The error names
/// `field`.
Status check_extents(const VoxelLayout& layout, const std::string& field);

/// "voxel (1, 2, 3)", of its layer or frame where there are several.
std::string voxel_name(const VoxelLayout& layout, std::uint64_t value_index);

/// The error of a file that holds one slice.
Error one_slice(const std::string& stage, const std::string& field, const std::string& found);

/// Checks that it is finite, not singular, with voxels of 1e-6 to 1e6 mm. The error names `field`.
Status check_affine(const std::string& stage, const std::string& field, const Eigen::Matrix4d& index_to_mm);

/// Puts checked parts together.
LabelVolume make_volume(const VoxelLayout& layout, const Eigen::Matrix4d& index_to_mm,
                        std::vector<Label> labels);

}  // namespace voxtet
