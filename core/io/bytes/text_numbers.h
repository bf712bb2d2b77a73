// Numbers as text: the same bytes and the same values on every platform, independent of the locale.
#pragma once

#include <string_view>

namespace voxtet {

inline constexpr int kRealChars = 32;  ///< room that format_real needs

/// Writes a finite number and returns the end of the text. Reading the text gives the same double again: 17
/// significant digits, or 15 or 16 where these already read back exactly ("12.3"). Plain notation between
/// 1e-4 and 1e15, exponents outside.
char* format_real(char* out, double value);

/// Reads a whole word as a finite decimal number. False for anything else: "nan", "inf", hexadecimal,
/// trailing characters, values beyond the range of double.
bool parse_real(std::string_view word, double& value);

}  // namespace voxtet
