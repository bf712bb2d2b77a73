// What options say, as texts of one or two parts.
#pragma once

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

}  // namespace voxtet
