#include "io/mesh/shared/igb_header.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include "io/bytes/byte_source.h"
#include "io/bytes/header_text.h"

namespace voxtet {
namespace {

using IgbValue = IgbHeader::Type;

constexpr const char* kIgbReader = "read_igb";

struct IgbType {
  std::string_view name;
  IgbValue type;
  std::size_t bytes;
};
constexpr std::array<IgbType, 7> kIgbTypes{{{"byte", IgbValue::kByte, 1},
                                            {"char", IgbValue::kChar, 1},
                                            {"short", IgbValue::kShort, 2},
                                            {"int", IgbValue::kInt, 4},
                                            {"uint", IgbValue::kUint, 4},
                                            {"float", IgbValue::kFloat, 4},
                                            {"double", IgbValue::kDouble, 8}}};

Error igb_error(const std::string& message) {
  return bad_input(kIgbReader, message);
}

/// The words of a header by their keyword. '#' and '*' begin a comment; a form feed ends the header.
Result<std::map<std::string, std::string>> words_of_header(std::string_view text) {
  text = text.substr(0, text.find('\f'));
  std::map<std::string, std::string> words;
  std::size_t at = 0;
  const auto is_gap = [](char c) { return is_space(c) || c == ',' || c == ';' || c == '\0'; };
  while (at < text.size()) {
    if (is_gap(text[at])) {
      ++at;
    } else if (text[at] == '#' || text[at] == '*') {
      at = std::min(text.find('\n', at), text.size());
    } else {
      std::size_t end = at;
      while (end < text.size() && !is_gap(text[end])) ++end;
      const std::string_view word = text.substr(at, end - at);
      const std::size_t colon = word.find(':');
      if (colon == std::string_view::npos)
        return igb_error("header: found " + in_quotes(word) + ", expected keyword:value");
      words[lower_case(word.substr(0, colon))] = word.substr(colon + 1);
      at = end;
    }
  }
  return words;
}

/// Looks words up; the first failure stays.
struct HeaderWords {
  std::map<std::string, std::string> words;
  std::optional<Error> error{};

  const std::string* find(const char* keyword) const {
    const auto found = words.find(keyword);
    return found == words.end() ? nullptr : &found->second;
  }
  void fail(const char* keyword, const std::string* found, const std::string& expected) {
    if (!error)
      error = igb_error(std::string(keyword) + ": found " + (found ? in_quotes(*found) : "none") +
                        ", expected " + expected);
  }
  std::uint64_t count(const char* keyword, bool required) {
    const std::string* text = find(keyword);
    if (!text && !required) return 1;
    const auto value = text ? parse_integer(*text) : std::nullopt;
    if (value && *value >= 1 && *value <= 0xffffffff) return static_cast<std::uint64_t>(*value);
    fail(keyword, text, "a whole number of at least 1");
    return 1;
  }
  double real(const char* keyword, double otherwise) {
    const std::string* text = find(keyword);
    if (!text) return otherwise;
    const auto value = parse_double(*text);
    if (value && std::isfinite(*value)) return *value;
    fail(keyword, text, "a finite number");
    return otherwise;
  }
};

double ms_of_unit(HeaderWords& words) {
  const std::string* unit = words.find("unites_t");
  if (!unit || *unit == "ms" || unit->empty()) return 1;
  if (*unit == "s") return 1000;
  words.fail("unites_t", unit, "ms or s");
  return 1;
}

template <class T>
double igb_value(const std::uint8_t* at, bool big_endian) {
  return static_cast<double>(load_value<T>(at, big_endian));
}

double raw_igb_value(const std::uint8_t* at, IgbValue type, bool big_endian) {
  switch (type) {
    case IgbValue::kByte: return *at;
    case IgbValue::kChar: return igb_value<std::int8_t>(at, big_endian);
    case IgbValue::kShort: return igb_value<std::int16_t>(at, big_endian);
    case IgbValue::kInt: return igb_value<std::int32_t>(at, big_endian);
    case IgbValue::kUint: return igb_value<std::uint32_t>(at, big_endian);
    case IgbValue::kFloat: return igb_value<float>(at, big_endian);
    case IgbValue::kDouble: break;
  }
  return igb_value<double>(at, big_endian);
}

/// Whether the file has the frames that its header promises.
std::optional<Error> check_igb_size(const IgbHeader& header, std::size_t file_bytes, std::string_view size) {
  const std::uint64_t found = file_bytes - IgbHeader::kBytes;
  // Both counts may be any number of a damaged header: no product that might not fit.
  const std::uint64_t frame = header.values * header.value_bytes();
  if (frame <= found && header.frames <= found / frame) {
    const std::uint64_t rest = found - header.frames * frame;
    if (rest <= 1) return std::nullopt;  // a form feed may end the file
  }
  return igb_error("found " + std::to_string(found) + " bytes behind the header, expected " +
                   std::to_string(header.frames) + " frames of " + std::string(size) + " values of " +
                   std::to_string(header.value_bytes()) + " bytes");
}

}  // namespace

std::size_t IgbHeader::value_bytes() const {
  return std::find_if(kIgbTypes.begin(), kIgbTypes.end(), [&](const IgbType& t) { return t.type == type; })
      ->bytes;
}

Result<IgbHeader> read_igb_header(std::span<const std::uint8_t> file) {
  if (file.size() < IgbHeader::kBytes)
    return igb_error("found " + std::to_string(file.size()) + " bytes, expected a header of 1024");
  Result<std::map<std::string, std::string>> found =
      words_of_header({reinterpret_cast<const char*>(file.data()), IgbHeader::kBytes});
  if (!found) return found.error();
  HeaderWords words{std::move(found).value()};

  IgbHeader header;
  const std::uint64_t x = words.count("x", true), y = words.count("y", true), z = words.count("z", false);
  header.frames = words.count("t", false);
  const std::string* type = words.find("type");
  const auto known = std::find_if(kIgbTypes.begin(), kIgbTypes.end(),
                                  [&](const IgbType& candidate) { return type && candidate.name == *type; });
  if (known == kIgbTypes.end())
    words.fail("type", type, "byte, char, short, int, uint, float or double");
  else
    header.type = known->type;
  const std::string* system = words.find("systeme");
  if (!system || (*system != "little_endian" && *system != "big_endian"))
    words.fail("systeme", system, "little_endian or big_endian");
  else
    header.big_endian = *system == "big_endian";
  header.facteur = words.real("facteur", 1);
  header.zero = words.real("zero", 0);
  if (const std::string* unit = words.find("unites"); unit && !unit->empty()) header.unit = *unit;

  const double ms = ms_of_unit(words);
  header.first_ms = ms * words.real("org_t", 0);
  const double duration = words.real("dim_t", 0);
  const bool by_duration = !words.find("inc_t") && words.find("dim_t") && header.frames > 1;
  header.interval_ms =
      ms * (by_duration ? duration / static_cast<double>(header.frames - 1) : words.real("inc_t", 1));
  if (header.frames > 1 && !(header.interval_ms > 0)) {
    const char* word = by_duration ? "dim_t" : "inc_t";
    words.fail(word, words.find(word), "more than 0");
  }
  if (words.error) return *std::move(words.error);

  const std::uint64_t most = file.size();
  if (x > most || y > most / x || z > most / (x * y))
    header.values = most;  // more than there can be
  else
    header.values = x * y * z;
  const std::string size = std::to_string(x) + " x " + std::to_string(y) + " x " + std::to_string(z);
  if (auto error = check_igb_size(header, file.size(), size)) return *std::move(error);
  return header;
}

Result<std::vector<float>> read_igb_frame(std::span<const std::uint8_t> file, const IgbHeader& header,
                                          std::size_t frame) {
  const std::size_t size = header.value_bytes();
  const std::uint8_t* at = file.data() + IgbHeader::kBytes + frame * header.values * size;
  std::vector<float> values;
  values.reserve(header.values);
  for (std::uint64_t i = 0; i < header.values; ++i, at += size) {
    const double value = raw_igb_value(at, header.type, header.big_endian) * header.facteur + header.zero;
    values.push_back(static_cast<float>(value));
    if (!std::isfinite(values.back()))
      return igb_error("frame " + std::to_string(frame) + ", value " + std::to_string(i) + ": found " +
                       number_text(value) + ", expected a finite number");
  }
  return values;
}

}  // namespace voxtet
