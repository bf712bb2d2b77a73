// Binary arithmetic coding: decisions and their probabilities <-> bytes. Carryless, 32 bits, as in Mahoney,
// "Adaptive weighing of context models for lossless data compression" (2005).
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "io/bytes/bytes.h"

namespace voxtet {

/// The part of a range of 32 bits in which the next decision is true or false.
class CodedRange {
 public:
  /// Where the range is divided for a decision that is true with this probability.
  std::uint32_t split(double probability) const {
    const auto part = static_cast<std::uint64_t>(std::clamp(probability * 65536, 1.0, 65535.0));
    return low + static_cast<std::uint32_t>((high - low) * part >> 16U);
  }
  void keep(bool below, std::uint32_t split) { below ? high = split : low = split + 1; }
  bool has_known_byte() const { return ((low ^ high) & 0xff000000U) == 0; }
  void drop_byte() {
    low <<= 8U;
    high = high << 8U | 0xffU;
  }

  std::uint32_t low = 0, high = 0xffffffffU;
};

class BinaryEncoder {
 public:
  /// Codes a decision that was held for true with this probability; gives it back.
  bool code(bool decision, double probability) {
    range_.keep(decision, range_.split(probability));
    for (; range_.has_known_byte(); range_.drop_byte())
      bytes_.push_back(static_cast<std::uint8_t>(range_.high >> 24U));
    return decision;
  }
  /// The bytes, with as few at the end as tell the last decisions.
  Bytes finish();

 private:
  CodedRange range_;
  Bytes bytes_;
};

class BinaryDecoder {
 public:
  explicit BinaryDecoder(std::span<const std::uint8_t> bytes) : bytes_(bytes) {
    for (int i = 0; i < 4; ++i) value_ = value_ << 8U | next_byte();
  }
  /// The decision that was coded with this probability.
  bool code(bool, double probability) {
    const std::uint32_t split = range_.split(probability);
    const bool decision = value_ <= split;
    range_.keep(decision, split);
    for (; range_.has_known_byte(); range_.drop_byte()) value_ = value_ << 8U | next_byte();
    return decision;
  }
  /// More was read than an encoder leaves out at the end: the data end too early.
  bool past_end() const { return at_ > bytes_.size() + 4; }

 private:
  std::uint8_t next_byte() {
    const std::uint8_t byte = at_ < bytes_.size() ? bytes_[at_] : 0;
    ++at_;
    return byte;
  }

  CodedRange range_;
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  std::uint32_t value_ = 0;
};

inline Bytes BinaryEncoder::finish() {
  // The shortest number within the range: a decoder reads zeros behind it.
  for (unsigned count = 1; count <= 4; ++count) {
    const std::uint32_t tail = count == 4 ? 0 : 0xffffffffU >> (8 * count);
    const std::uint32_t number = range_.high & ~tail;
    if (number < range_.low) continue;
    for (unsigned i = 0; i < count; ++i)
      bytes_.push_back(static_cast<std::uint8_t>(number >> (24 - 8 * i) & 0xffU));
    break;
  }
  while (!bytes_.empty() && bytes_.back() == 0) bytes_.pop_back();
  return std::move(bytes_);
}

}  // namespace voxtet
