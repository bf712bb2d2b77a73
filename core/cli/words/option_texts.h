// What options say, as texts of one or two parts.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>
#include <utility>

#include "types/result.h"

namespace voxtet {

/// In the place of a file: standard input or output.
inline constexpr const char* kDash = "-";

/// "a=b" -> {a, b}. Errors: kUsage, with the form that was expected.
Result<std::pair<std::string, std::string>> split_pair(const std::string& option, const std::string& text,
                                                       const std::string& form);

/// "2", "2mm", "0.2 cm", "800um" -> mm. `option` begins the messages. Errors: kUsage.
Result<double> to_mm(const std::string& option, const std::string& text);

/// Refuses a text that is no number which `fits`, and says the form that was expected.
CLI::Validator number_as(const std::string& form, bool (*fits)(double));
inline bool is_whole(double value) {
  return value == std::trunc(value);
}

}  // namespace voxtet
