// Voxel bytes in sequence, from memory or inflated while reading; at most one block is in memory.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "types/result.h"

namespace voxtet {

/// A volume file that is damaged or unsupported. The name of the file is put in front by read_volume.
inline Error bad_input(const std::string& stage, const std::string& message) {
  return {ErrorCode::kBadInput, stage, message, {}};
}

/// The value of arithmetic type T at `at`, in either byte order (every supported platform is little-endian).
template <class T>
T load_value(const std::uint8_t* at, bool big_endian) {
  std::array<std::uint8_t, sizeof(T)> bytes;
  std::memcpy(bytes.data(), at, sizeof(T));
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  T value;
  std::memcpy(&value, bytes.data(), sizeof(T));
  return value;
}

class ByteSource {
 public:
  virtual ~ByteSource() = default;
  /// Fills `out` and returns its size, or returns less at the end of the data. Errors: kBadInput (damaged
  /// stream).
  virtual Result<std::size_t> read(std::span<std::uint8_t> out) = 0;
  /// Upper bound of the bytes that can still come, so that memory can be allocated for them.
  virtual std::uint64_t at_most_left() const = 0;
  virtual bool compressed() const = 0;
  /// Zero bytes that stood behind the end of the data, once that has been reached.
  virtual std::uint64_t padding() const { return 0; }
};

/// Reads and drops `count` bytes. Errors: kBadInput if the data end before; the message names `what`.
Status skip_bytes(ByteSource& source, std::uint64_t count, const std::string& what);

/// The bytes themselves; they must outlive the source.
std::unique_ptr<ByteSource> make_memory_source(std::span<const std::uint8_t> bytes);

/// Inflates gzip (one or more members) or zlib data, told apart by their headers, and verifies every checksum
/// and length. Bytes other than zero after the end of the compressed data are an error, a missing trailer
/// too.
std::unique_ptr<ByteSource> make_inflate_source(std::span<const std::uint8_t> bytes);

/// Deflates into one gzip member with neither name nor time, the same bytes on every platform.
Result<std::vector<std::uint8_t>> gzip_bytes(std::span<const std::uint8_t> bytes);

}  // namespace voxtet
