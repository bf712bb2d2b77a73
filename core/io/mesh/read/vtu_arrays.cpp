#include "io/mesh/read/vtu_arrays.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <functional>
#include <type_traits>

#include "io/bytes/header_text.h"
#include "io/bytes/text_numbers.h"

namespace voxtet {
namespace {

/// zlib never shrinks more than about 1032 times.
constexpr std::uint64_t kMostInflation = 1040;
constexpr double kMostWhole = 9007199254740992.0;

Error array_error(const VtuArray& array, const std::string& message) {
  return {ErrorCode::kBadInput,
          "read_vtu",
          std::string(array.section) + " array " + in_quotes(array.name) + ": " + message,
          {}};
}

constexpr std::array<std::int8_t, 256> kBase64 = [] {
  std::array<std::int8_t, 256> table{};
  for (std::int8_t& entry : table) entry = -1;
  const char* const letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::int8_t i = 0; i < 64; ++i) table[static_cast<unsigned char>(letters[i])] = i;
  return table;
}();

/// The first `wanted` bytes or as many as there are. A padded group may be followed by another run: VTK pads
/// the header of compressed data on its own.
Bytes base64_prefix(std::string_view text, std::uint64_t wanted) {
  Bytes bytes;
  bytes.reserve(static_cast<std::size_t>(std::min<std::uint64_t>(wanted + 2, text.size())));
  std::uint32_t group = 0;
  int letters = 0, padding = 0;
  for (const char c : text) {
    if (bytes.size() >= wanted) break;
    if (is_space(c)) continue;
    const std::int8_t value = kBase64[static_cast<unsigned char>(c)];
    if (value < 0 && (c != '=' || letters < 2)) break;
    if (value >= 0 && padding > 0) break;
    padding += value < 0;
    group = group << 6 | static_cast<std::uint32_t>(value < 0 ? 0 : value);
    if (++letters < 4) continue;
    for (int i = 0; i < 3 - padding; ++i) bytes.push_back(static_cast<std::uint8_t>(group >> (16 - 8 * i)));
    group = 0;
    letters = padding = 0;
  }
  if (bytes.size() > wanted) bytes.resize(static_cast<std::size_t>(wanted));
  return bytes;
}

std::uint64_t header_value(const std::uint8_t* at, std::size_t size) {
  std::uint64_t value = 0;
  std::memcpy(&value, at, size);
  return value;
}

/// `first(n)`: the first n bytes of the encoded array, or fewer where the file ends.
using FirstBytes = std::function<Bytes(std::uint64_t)>;

Result<Bytes> plain_content(const VtuArray& array, const FirstBytes& first, std::uint64_t expected,
                            std::size_t word) {
  const Bytes header = first(word);
  if (header.size() < word) return array_error(array, "the data end inside the header");
  const std::uint64_t size = header_value(header.data(), word);
  if (size != expected)
    return array_error(
        array, "the header says " + std::to_string(size) + " bytes, expected " + std::to_string(expected));
  Bytes bytes = first(word + expected);
  if (bytes.size() != word + expected)
    return array_error(array, "the data end after " + std::to_string(bytes.size() - word) + " of " +
                                  std::to_string(expected) + " bytes");
  bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(word));
  return bytes;
}

struct Blocks {
  std::uint64_t full = 0, last = 0;
  std::vector<std::uint64_t> stored;
};

Result<Blocks> read_blocks(const VtuArray& array, const FirstBytes& first, std::uint64_t most_bytes,
                           std::uint64_t expected, std::size_t word) {
  const Bytes count = first(word);
  if (count.size() < word) return array_error(array, "the data end inside the header");
  const std::uint64_t blocks = header_value(count.data(), word);
  if (blocks == 0 && expected == 0) return Blocks{};
  if (blocks == 0 || blocks > most_bytes / word)
    return array_error(
        array, std::to_string(blocks) + " compressed blocks in " + std::to_string(most_bytes) + " bytes");
  const Bytes header = first(word * (3 + blocks));
  if (header.size() < word * (3 + blocks)) return array_error(array, "the data end inside the header");
  Blocks result{header_value(&header[word], word), header_value(&header[2 * word], word), {}};
  if (result.last == 0) result.last = result.full;
  std::uint64_t stored = 0;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    result.stored.push_back(header_value(&header[word * (3 + b)], word));
    if (result.stored.back() > most_bytes - stored)
      return array_error(array, "compressed blocks exceed the file");
    stored += result.stored.back();
  }
  // The first comparison keeps the product below from overflowing.
  if ((blocks > 1 && result.full > expected / (blocks - 1)) || result.last > expected ||
      expected - result.last != (blocks - 1) * result.full || expected > kMostInflation * stored + 64)
    return array_error(array, std::to_string(blocks) + " blocks of " + std::to_string(result.full) +
                                  " bytes (the last of " + std::to_string(result.last) + "), expected " +
                                  std::to_string(expected) + " bytes in all");
  return result;
}

Result<Bytes> compressed_content(const VtuArray& array, const FirstBytes& first, std::uint64_t most_bytes,
                                 std::uint64_t expected, std::size_t word) {
  const Result<Blocks> blocks = read_blocks(array, first, most_bytes, expected, word);
  if (!blocks.ok()) return blocks.error();
  const std::uint64_t header = word * (3 + blocks->stored.size());
  std::uint64_t total = header;
  for (const std::uint64_t size : blocks->stored) total += size;
  const Bytes encoded = first(total);
  if (!blocks->stored.empty() && encoded.size() != total)
    return array_error(array, "the compressed data end early");
  Bytes bytes(static_cast<std::size_t>(expected));
  std::size_t from = static_cast<std::size_t>(header), to = 0;
  for (std::size_t b = 0; b < blocks->stored.size(); ++b) {
    const std::uint64_t wanted = b + 1 < blocks->stored.size() ? blocks->full : blocks->last;
    auto length = static_cast<uLongf>(wanted);
    const int code =
        uncompress(bytes.data() + to, &length, encoded.data() + from, static_cast<uLong>(blocks->stored[b]));
    if (code != Z_OK || length != wanted)
      return array_error(array, "compressed block " + std::to_string(b + 1) + " is damaged");
    to += static_cast<std::size_t>(wanted);
    from += static_cast<std::size_t>(blocks->stored[b]);
  }
  return bytes;
}

template <class T>
bool convert(double value, T& result) {
  if constexpr (std::is_same_v<T, double>) {
    result = value;
    return std::isfinite(value);
  } else {
    if (!(std::abs(value) <= kMostWhole) || std::floor(value) != value) return false;
    result = static_cast<T>(value);
    return true;
  }
}

template <class Stored, class T>
bool convert_all(const Bytes& bytes, std::vector<T>& values, std::size_t& bad) {
  values.resize(bytes.size() / sizeof(Stored));
  for (std::size_t i = 0; i < values.size(); ++i) {
    Stored stored;
    std::memcpy(&stored, bytes.data() + i * sizeof(Stored), sizeof(Stored));
    bad = i;
    if constexpr (std::is_integral_v<Stored>) {
      if constexpr (std::is_same_v<Stored, std::uint64_t>)
        if (stored > static_cast<std::uint64_t>(INT64_MAX)) return false;
      values[i] = static_cast<T>(stored);
    } else if (!convert(static_cast<double>(stored), values[i])) {
      return false;
    }
  }
  return true;
}

template <class T>
bool convert_type(std::string_view type, const Bytes& bytes, std::vector<T>& values, std::size_t& bad) {
  if (type == "Float64") return convert_all<double>(bytes, values, bad);
  if (type == "Float32") return convert_all<float>(bytes, values, bad);
  if (type == "Int64") return convert_all<std::int64_t>(bytes, values, bad);
  if (type == "UInt64") return convert_all<std::uint64_t>(bytes, values, bad);
  if (type == "Int32") return convert_all<std::int32_t>(bytes, values, bad);
  if (type == "UInt32") return convert_all<std::uint32_t>(bytes, values, bad);
  if (type == "Int16") return convert_all<std::int16_t>(bytes, values, bad);
  if (type == "UInt16") return convert_all<std::uint16_t>(bytes, values, bad);
  if (type == "Int8") return convert_all<std::int8_t>(bytes, values, bad);
  return convert_all<std::uint8_t>(bytes, values, bad);
}

std::size_t size_of_type(std::string_view type) {
  if (type == "Float64" || type == "Int64" || type == "UInt64") return 8;
  if (type == "Float32" || type == "Int32" || type == "UInt32") return 4;
  if (type == "Int16" || type == "UInt16") return 2;
  if (type == "Int8" || type == "UInt8" || type == "String") return 1;
  return 0;
}

template <class T>
Result<std::vector<T>> ascii_values(const VtuArray& array, std::uint64_t count) {
  if (count > array.text.size() / 2 + 1)
    return array_error(array, std::to_string(array.text.size()) + " characters, expected " +
                                  std::to_string(count) + " numbers");
  std::vector<T> values;
  values.reserve(static_cast<std::size_t>(count));
  const char* at = array.text.data();
  const char* const end = at + array.text.size();
  for (;;) {
    while (at != end && is_space(*at)) ++at;
    if (at == end) break;
    const char* stop = at;
    while (stop != end && !is_space(*stop)) ++stop;
    const std::string_view word(at, static_cast<std::size_t>(stop - at));
    T value{};
    bool good = false;
    if constexpr (std::is_integral_v<T>) {
      const auto [last, code] = std::from_chars(at, stop, value);
      good = code == std::errc{} && last == stop;
    }
    double real = 0;
    good = good || (parse_real(word, real) && convert(real, value));
    if (!good || values.size() == count)
      return array_error(array,
                         "found " + in_quotes(word) + (good ? " behind " : " as number ") +
                             (good ? std::to_string(count) + " numbers" : std::to_string(values.size() + 1)));
    values.push_back(value);
    at = stop;
  }
  if (values.size() != count)
    return array_error(array, std::to_string(values.size()) + " numbers, expected " + std::to_string(count));
  return values;
}

}  // namespace

Status VtuArrays::check() const {
  const auto refuse = [](const char* field, std::string_view found, const char* expected) {
    return Error{ErrorCode::kBadInput,
                 "read_vtu",
                 "VTKFile " + std::string(field) + " is " + in_quotes(found) + ", expected " + expected,
                 {}};
  };
  if (document_.grid_type != "UnstructuredGrid")
    return refuse("type", document_.grid_type, "UnstructuredGrid");
  if (!document_.byte_order.empty() && document_.byte_order != "LittleEndian")
    return refuse("byte_order", document_.byte_order, "LittleEndian");
  if (!document_.header_type.empty() && document_.header_type != "UInt32" &&
      document_.header_type != "UInt64")
    return refuse("header_type", document_.header_type, "UInt32 or UInt64");
  if (!document_.compressor.empty() && document_.compressor != "vtkZLibDataCompressor")
    return refuse("compressor", document_.compressor, "none or vtkZLibDataCompressor");
  return std::monostate{};
}

Result<Bytes> VtuArrays::content(const VtuArray& array, std::uint64_t expected_bytes) const {
  std::string_view stream = array.text;
  bool raw = false;
  if (array.format == "appended") {
    std::uint64_t offset = 0;
    const auto [stop, code] =
        std::from_chars(array.offset.data(), array.offset.data() + array.offset.size(), offset);
    if (code != std::errc{} || stop != array.offset.data() + array.offset.size() ||
        offset > document_.appended.size())
      return array_error(array, "offset " + in_quotes(array.offset) + " in " +
                                    std::to_string(document_.appended.size()) + " bytes of appended data");
    stream = document_.appended.substr(static_cast<std::size_t>(offset));
    raw = document_.appended_encoding == "raw";
  } else if (array.format != "binary") {
    return array_error(array, "format " + in_quotes(array.format) + ", expected ascii, binary or appended");
  }
  const FirstBytes first = [&](std::uint64_t count) {
    if (!raw) return base64_prefix(stream, count);
    const auto* begin = reinterpret_cast<const std::uint8_t*>(stream.data());
    return Bytes(begin, begin + std::min<std::uint64_t>(count, stream.size()));
  };
  const std::size_t word = document_.header_type == "UInt64" ? 8 : 4;
  if (document_.compressor.empty()) return plain_content(array, first, expected_bytes, word);
  return compressed_content(array, first, stream.size(), expected_bytes, word);
}

template <class T>
Result<std::vector<T>> VtuArrays::values(const VtuArray& array, std::uint64_t count) const {
  const std::size_t size = size_of_type(array.type);
  if (size == 0) return array_error(array, "type " + in_quotes(array.type) + " is not known");
  if (array.format.empty() || array.format == "ascii") return ascii_values<T>(array, count);
  if (count > UINT64_MAX / kMostInflation / size)
    return array_error(array, std::to_string(count) + " values");
  const Result<Bytes> bytes = content(array, count * size);
  if (!bytes.ok()) return bytes.error();
  std::vector<T> result;
  std::size_t bad = 0;
  if (!convert_type(array.type, *bytes, result, bad))
    return array_error(array, "value " + std::to_string(bad + 1) + " is not " +
                                  (std::is_integral_v<T> ? "a whole number" : "finite"));
  return result;
}

Result<std::vector<double>> VtuArrays::reals(const VtuArray& array, std::uint64_t count) const {
  return values<double>(array, count);
}

Result<std::vector<std::int64_t>> VtuArrays::integers(const VtuArray& array, std::uint64_t count) const {
  return values<std::int64_t>(array, count);
}

}  // namespace voxtet
