#include "io/volume/voxels/length_unit.h"

#include <algorithm>
#include <array>
#include <string>

#include "io/bytes/header_text.h"

namespace voxtet {
namespace {

struct UnitNames {
  double mm;
  std::array<std::string_view, 7> names;  ///< lower case, singular; the rest empty
};
constexpr std::array<UnitNames, 8> kUnits{{
    {1e6, {"km", "kilometer", "kilometre"}},
    {1000, {"m", "meter", "metre"}},
    {100, {"dm", "decimeter", "decimetre"}},
    {10, {"cm", "centimeter", "centimetre"}},
    {1, {"mm", "millimeter", "millimetre"}},
    // The micro sign, the Greek letter, and the micro sign in Latin-1.
    {0.001, {"um", "\xc2\xb5m", "\xce\xbcm", "\xb5m", "micron", "micrometer", "micrometre"}},
    {1e-6, {"nm", "nanometer", "nanometre"}},
    {25.4, {"in", "inch", "inches"}},
}};

}  // namespace

std::optional<double> mm_per_length_unit(std::string_view name) {
  const std::string lower = lower_case(trimmed(name));
  const bool plural = lower.size() > 3 && lower.ends_with('s');
  for (const std::string& word : {lower, plural ? lower.substr(0, lower.size() - 1) : lower})
    for (const UnitNames& unit : kUnits)
      if (!word.empty() && std::find(unit.names.begin(), unit.names.end(), word) != unit.names.end())
        return unit.mm;
  return std::nullopt;
}

std::optional<double> mm_per_unit_of(const ReadOptions& options) {
  switch (options.unit) {
    case LengthUnit::kOfFile: return std::nullopt;
    case LengthUnit::kMetre: return 1000;
    case LengthUnit::kCentimetre: return 10;
    case LengthUnit::kMillimetre: return 1;
    case LengthUnit::kMicrometre: return 0.001;
    case LengthUnit::kNanometre: return 1e-6;
  }
  return std::nullopt;
}

}  // namespace voxtet
