// What options say, as texts of one or two parts.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "types/result.h"

namespace voxtet {

/// In the place of a file: standard input or output.
inline constexpr const char* kDash = "-";

/// "a=b" -> {a, b}. Errors: kUsage, with the form that was expected.
Result<std::pair<std::string, std::string>> split_pair(const std::string& option, const std::string& text,
                                                       const std::string& form);

/// The parts of a text between separators: one more than there are separators.
std::vector<std::string> split(const std::string& text, char separator);

/// "0,0.5,-1" -> three finite numbers; nothing for another text.
std::optional<std::array<double, 3>> three_numbers(const std::string& text);

/// "2", "2mm", "0.2 cm", "800um" -> mm. `option` begins the messages. Errors: kUsage.
Result<double> to_mm(const std::string& option, const std::string& text);

/// Refuses a text that is no number which `fits`, and says the form that was expected.
CLI::Validator number_as(const std::string& form, bool (*fits)(double));
inline bool is_whole(double value) {
  return value == std::trunc(value);
}

}  // namespace voxtet
