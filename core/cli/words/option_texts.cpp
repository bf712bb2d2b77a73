#include "cli/words/option_texts.h"

#include <cstdlib>

#include "io/volume/voxels/length_unit.h"

namespace voxtet {

Result<std::pair<std::string, std::string>> split_pair(const std::string& option, const std::string& text,
                                                       const std::string& form) {
  const std::size_t at = text.find('=');
  if (at != std::string::npos && at > 0) return std::pair{text.substr(0, at), text.substr(at + 1)};
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos || colon == 0)
    return usage_error("cli", option + " " + text + ": expected " + form);
  return usage_error("cli", option + " " + text + ": expected " + text.substr(0, colon) + "=" +
                                text.substr(colon + 1) + ", with = for :");
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

std::optional<std::array<double, 3>> three_numbers(const std::string& text) {
  const std::vector<std::string> parts = split(text, ',');
  std::array<double, 3> numbers{};
  if (parts.size() != numbers.size()) return std::nullopt;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    char* end = nullptr;
    numbers[i] = std::strtod(parts[i].c_str(), &end);
    if (end == parts[i].c_str() || *end != '\0' || !std::isfinite(numbers[i])) return std::nullopt;
  }
  return numbers;
}

CLI::Validator number_as(const std::string& form, bool (*fits)(double)) {
  const auto judge = [form, fits](const std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    const bool whole_text = end != text.c_str() && *end == '\0';
    return whole_text && std::isfinite(value) && fits(value) ? "" : "found '" + text + "', expected " + form;
  };
  return CLI::Validator(judge, "");
}

Result<double> to_mm(const std::string& option, const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const std::string unit = end;
  const std::optional<double> mm = unit.empty() ? 1 : mm_per_length_unit(unit);
  if (end == text.c_str() || !mm || !std::isfinite(value))
    return usage_error("cli", option + ": found '" + text +
                                  "', expected a length as 2, 2mm, 0.2cm or 800um (mm if it has no unit)");
  return *mm < 1 ? value / std::round(1 / *mm) : value * *mm;
}

}  // namespace voxtet
