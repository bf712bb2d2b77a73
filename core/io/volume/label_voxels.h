// Typed voxel bytes -> labels or numbers; numbers written as text -> labels.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/bytes/byte_source.h"
#include "types/label_volume.h"
#include "types/result.h"

namespace voxtet {

enum class VoxelType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kInt64, kUint64, kFloat32, kFloat64 };

std::size_t bytes_of(VoxelType type);

/// How a file stores its voxels. Extents are checked by `check_extents`, not here.
struct VoxelLayout {
  std::string stage;  ///< the reader, for errors
  std::array<std::int64_t, 3> size{1, 1, 1};
  std::int64_t layers = 1;  ///< values per voxel, running fastest
  VoxelType type = VoxelType::kUint8;
  bool big_endian = false;
  double slope = 1, inter = 0;  ///< value = slope * stored + inter

  std::uint64_t value_count() const {
    return static_cast<std::uint64_t>(layers) * static_cast<std::uint64_t>(size[0]) *
           static_cast<std::uint64_t>(size[1]) * static_cast<std::uint64_t>(size[2]);
  }
};

/// Checks that each extent is in 1..2^31-1 and that the bytes of all values fit into memory. The error names
/// `field`.
Status check_extents(const VoxelLayout& layout, const std::string& field);

/// Reads exactly the values of a checked layout, to the end of the source. Unscaled values must be whole;
/// scaled ones whole to one part in 10^6, since slopes are stored in single precision. Values must be in
/// 0..65535. Nothing is allocated before the source is known to hold that many bytes (compressed: to be able
/// to). Errors: kBadInput naming the first offending voxel, or too few or too many bytes.
Result<std::vector<Label>> read_labels(ByteSource& source, const VoxelLayout& layout);

/// The same for any values, NaN and infinity included.
Result<std::vector<float>> read_scalars(ByteSource& source, const VoxelLayout& layout);

/// Labels from whole numbers written in decimal, separated by white space. White space must also follow the
/// last one: without it a number that was cut could not be told from a whole one.
Result<std::vector<Label>> read_text_labels(std::span<const std::uint8_t> text, const VoxelLayout& layout);

/// Checks that it is finite, not singular, with voxels of 1e-6 to 1e6 mm. The error names `field`.
Status check_affine(const std::string& stage, const std::string& field, const Eigen::Matrix4d& index_to_mm);

/// Puts checked parts together.
LabelVolume make_volume(const VoxelLayout& layout, const Eigen::Matrix4d& index_to_mm,
                        std::vector<Label> labels);

}  // namespace voxtet
