#include "io/bytes/header_text.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>

namespace voxtet {
namespace {

template <class T, class Parse>
std::optional<std::vector<T>> parse_all(std::string_view text, Parse parse) {
  std::vector<T> values;
  for (const std::string& word : words_of(text)) {
    const std::optional<T> value = parse(word);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  std::size_t at = 0;
  while (true) {
    while (at < text.size() && is_space(text[at])) ++at;
    if (at == text.size()) return words;
    const std::size_t begin = at;
    while (at < text.size() && !is_space(text[at])) ++at;
    words.emplace_back(text.substr(begin, at - begin));
  }
}

std::optional<double> parse_double(std::string_view text) {
  const std::string copy(text);
  // strtod also takes leading white space and hexadecimal numbers, which no header has.
  if (copy.empty() || is_space(copy.front()) || copy.find_first_of("xX") != std::string::npos)
    return std::nullopt;
  char* end = nullptr;
  const double value = std::strtod(copy.c_str(), &end);
  if (end != copy.c_str() + copy.size()) return std::nullopt;
  return value;
}

std::optional<std::int64_t> parse_integer(std::string_view text) {
  std::int64_t value = 0;
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<std::vector<double>> parse_doubles(std::string_view text) {
  return parse_all<double>(text, parse_double);
}

std::optional<std::vector<std::int64_t>> parse_integers(std::string_view text) {
  return parse_all<std::int64_t>(text, parse_integer);
}

std::string number_text(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

std::string in_quotes(std::string_view text) {
  std::string safe(1, '"');
  for (const char c : text.substr(0, 60)) safe += c < ' ' || c > '~' ? '?' : c;
  safe += text.size() > 60 ? "...\"" : "\"";
  return safe;
}

std::optional<std::string_view> next_line(std::span<const std::uint8_t> bytes, std::size_t& at, bool& ended) {
  if (at >= bytes.size()) return std::nullopt;
  std::string_view rest(reinterpret_cast<const char*>(bytes.data()) + at, bytes.size() - at);
  const std::size_t length = rest.find('\n');
  ended = length != std::string_view::npos;
  std::string_view line = rest.substr(0, length);
  at += line.size() + (ended ? 1 : 0);
  if (ended && line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

}  // namespace voxtet
