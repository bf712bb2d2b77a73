// HDF5 files of a few arrays, written without the library ("HDF5 File Format Specification Version 2.0",
// https://docs.hdfgroup.org/hdf5/v1_14/_f_m_t2.html).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/bytes/byte_writer.h"

namespace voxtet {

enum class Hdf5Type { kInt32, kFloat32, kFloat64 };

/// A data set at the root of the file.
struct Hdf5Array {
  std::string name;
  Hdf5Type type = Hdf5Type::kInt32;
  std::vector<std::uint64_t> shape;  ///< slowest first
};

/// A writer with everything of the file except the values of the arrays. These must follow, little-endian, in
/// the order of `arrays` and without gaps. Names must differ. Every version of the library can read this: it
/// is the oldest form of the format (superblock 0, one symbol table node, contiguous layout).
ByteWriter begin_hdf5(const std::vector<Hdf5Array>& arrays);

}  // namespace voxtet
