// The saved state of a simulation as bytes: lengths and values, one after the other.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/bytes/bytes.h"

namespace voxtet {

class CheckpointWriter {
 public:
  /// `kind`: a line that says what the bytes are, and their version.
  explicit CheckpointWriter(std::string_view kind) { put(kind.data(), kind.size()); }

  void text(const std::string& text) {
    value(static_cast<std::uint64_t>(text.size()));
    put(text.data(), text.size());
  }
  template <class T>
  void value(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    put(&value, sizeof(T));
  }
  template <class T>
  void list(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    value(static_cast<std::uint64_t>(values.size()));
    put(values.data(), values.size() * sizeof(T));
  }
  Bytes take() { return std::move(bytes_); }

 private:
  void put(const void* from, std::size_t size) {
    const auto* const bytes = static_cast<const std::uint8_t*>(from);
    bytes_.insert(bytes_.end(), bytes, bytes + size);
  }

  Bytes bytes_;
};

/// What does not fit into the bytes is left as it was, and complete() is false.
class CheckpointReader {
 public:
  CheckpointReader(std::string_view kind, const Bytes& bytes)
      : bytes_(bytes),
        is_ours_(bytes.size() >= kind.size() && std::memcmp(bytes.data(), kind.data(), kind.size()) == 0),
        at_(is_ours_ ? kind.size() : 0) {}

  bool is_ours() const { return is_ours_; }  ///< whether the bytes are of that kind
  bool complete() const { return complete_ && at_ == bytes_.size(); }

  void text(std::string& text) {
    text.resize(length(1));
    take(text.data(), text.size());
  }
  template <class T>
  void value(T& value) {
    if (fits(sizeof(T))) take(&value, sizeof(T));
  }
  template <class T>
  void list(std::vector<T>& values) {
    values.resize(length(sizeof(T)));
    take(values.data(), values.size() * sizeof(T));
  }

 private:
  bool fits(std::uint64_t size) {
    complete_ = complete_ && size <= bytes_.size() - at_;
    return complete_;
  }
  std::size_t length(std::size_t of_one) {
    std::uint64_t count = 0;
    value(count);
    if (count > bytes_.size()) complete_ = false;
    return complete_ && fits(count * of_one) ? static_cast<std::size_t>(count) : 0;
  }
  void take(void* to, std::size_t size) {
    if (size == 0) return;
    std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }

  const Bytes& bytes_;
  bool is_ours_;
  std::size_t at_;
  bool complete_ = true;
};

}  // namespace voxtet
