// A growing file in memory: text and raw little-endian values, without a stream per number.
#pragma once

#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <utility>

#include "io/bytes/bytes.h"
#include "io/bytes/text_numbers.h"

namespace voxtet {

static_assert(std::endian::native == std::endian::little, "the formats written here are little-endian");

class ByteWriter {
 public:
  explicit ByteWriter(std::size_t expected_bytes) { bytes_.resize(expected_bytes); }

  void text(std::string_view text) {
    std::memcpy(room(text.size()), text.data(), text.size());
    used_ += text.size();
  }
  void integer(std::int64_t value) {
    char* start = room(24);
    used_ += static_cast<std::size_t>(std::to_chars(start, start + 24, value).ptr - start);
  }
  void real(double value) {
    char* start = room(kRealChars);
    used_ += static_cast<std::size_t>(format_real(start, value) - start);
  }
  template <class T>
  void raw(T value) {
    static_assert(std::is_arithmetic_v<T>);
    std::memcpy(room(sizeof(T)), &value, sizeof(T));
    used_ += sizeof(T);
  }
  Bytes take() {
    bytes_.resize(used_);
    return std::move(bytes_);
  }

 private:
  char* room(std::size_t count) {
    if (used_ + count > bytes_.size()) bytes_.resize(2 * bytes_.size() + count + 256);
    return reinterpret_cast<char*>(bytes_.data() + used_);
  }

  Bytes bytes_;
  std::size_t used_ = 0;
};

}  // namespace voxtet
