// The header of a NIfTI file, of either version.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "io/bytes/byte_source.h"
#include "io/volume/voxels/voxel_layout.h"

namespace voxtet {

inline constexpr const char* kNiftiReader = "read_nifti";

inline Error bad_nifti(const std::string& message) {
  return bad_input(kNiftiReader, message);
}

/// The fields that both versions have, widened. Lengths still in the file's unit.
struct NiftiHeader {
  bool big_endian = false;
  int version = 1;
  std::array<std::uint8_t, 8> magic{};
  std::array<std::int64_t, 8> dim{};
  std::int64_t datatype = 0, bitpix = 0, sform_code = 0, qform_code = 0, units = 0;
  double vox_offset = 0, slope = 0, inter = 0;
  std::array<double, 8> pixdim{};
  std::array<double, 3> quatern{}, qoffset{};
  std::array<double, 12> srow{};
};

/// Reads the header of a single file. Errors: kBadInput for a header that is cut, or of another format.
Result<NiftiHeader> read_nifti_header(ByteSource& source);

/// Frames where one dimension beyond the third is larger than 1. Errors: kBadInput naming the field.
Result<VoxelLayout> nifti_layout(const NiftiHeader& header);

/// Leaves out what stands between the header and the first voxel.
Status skip_to_voxels(const NiftiHeader& header, ByteSource& source);

}  // namespace voxtet
