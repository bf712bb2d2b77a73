// Numbers in few bytes, at the head of a coded volume.
#pragma once

#include <cstdint>
#include <span>

#include "io/bytes/bytes.h"

namespace voxtet {

/// Seven bits a byte, the lowest first.
void put_number(Bytes& bytes, std::uint64_t number);

/// A double, exactly: as a short decimal, in single precision, or as it is.
void put_real(Bytes& bytes, double value);

/// Reads what the functions above have put. Behind the end of the bytes everything is 0, and failed().
class NumberReader {
 public:
  explicit NumberReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  std::uint64_t number();
  double real();
  std::uint8_t byte();
  bool failed() const { return failed_; }
  std::span<const std::uint8_t> rest() const { return bytes_.subspan(at_); }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  bool failed_ = false;
};

}  // namespace voxtet
