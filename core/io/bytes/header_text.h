// Small pieces of text headers: white space, numbers, words.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace voxtet {

/// White space as in the C locale, whatever locale the process has set.
inline bool is_space(int c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

std::string_view trimmed(std::string_view text);
std::string lower_case(std::string_view text);  ///< ASCII only
std::vector<std::string> words_of(std::string_view text);

/// The whole text as a decimal number ("nan" and "inf" included), or nothing.
std::optional<double> parse_double(std::string_view text);
/// The whole text as a decimal integer, or nothing (also when it does not fit).
std::optional<std::int64_t> parse_integer(std::string_view text);
/// All words as numbers, or nothing if one of them is no number.
std::optional<std::vector<double>> parse_doubles(std::string_view text);
std::optional<std::vector<std::int64_t>> parse_integers(std::string_view text);

/// Shortest text of 9 significant digits, for messages.
std::string number_text(double value);
/// At most 60 characters of file content in quotes, unprintable ones replaced by '?'.
std::string in_quotes(std::string_view text);

/// One line starting at `at`, without its line end (\n or \r\n); `at` moves behind it. Nothing at the end of
/// the data. `ended` tells whether there was a line end.
std::optional<std::string_view> next_line(std::span<const std::uint8_t> bytes, std::size_t& at, bool& ended);

}  // namespace voxtet
