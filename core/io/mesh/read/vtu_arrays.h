// The values of a .vtu file's arrays, whatever their type, encoding and compression.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "io/bytes/bytes.h"
#include "io/mesh/read/vtu_xml.h"

namespace voxtet {

/// Decodes arrays of one document. Memory is allocated only for what the bytes of the file can hold. The
/// document must have passed `check`. Error messages name the array and no file.
class VtuArrays {
 public:
  explicit VtuArrays(const VtuDocument& document) : document_(document) {}

  /// Whether type, byte order, header type and compressor are supported.
  Status check() const;
  /// Exactly `count` finite numbers.
  Result<std::vector<double>> reals(const VtuArray& array, std::uint64_t count) const;
  /// Exactly `count` whole numbers; real arrays are accepted when all values are whole and below 2^53.
  Result<std::vector<std::int64_t>> integers(const VtuArray& array, std::uint64_t count) const;

 private:
  template <class T>
  Result<std::vector<T>> values(const VtuArray& array, std::uint64_t count) const;
  Result<Bytes> content(const VtuArray& array, std::uint64_t expected_bytes) const;

  const VtuDocument& document_;
};

}  // namespace voxtet
