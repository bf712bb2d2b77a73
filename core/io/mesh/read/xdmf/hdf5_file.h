// Arrays of an HDF5 file, read without the library ("HDF5 File Format Specification Version 2.0",
// https://docs.hdfgroup.org/hdf5/v1_14/_f_m_t2.html).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "types/result.h"

namespace voxtet {

struct Hdf5Values {
  std::vector<std::uint64_t> shape;  ///< slowest first
  std::vector<double> values;        ///< may be NaN; whole numbers beyond 2^53 are rounded
};

/// The array at a path, as "/Mesh/mesh/geometry", as far as the format's oldest form goes, which the library
/// writes unless it is told otherwise: superblock 0, groups by symbol tables, little-endian whole or real
/// numbers of 1 to 8 bytes, in one block or in chunks with deflate and shuffle, as meshio writes them. Memory
/// is allocated only for what the bytes can hold. Errors: kBadInput naming what was found and expected,
/// without the file's name.
Result<Hdf5Values> read_hdf5(std::span<const std::uint8_t> file, std::string_view path);

}  // namespace voxtet
