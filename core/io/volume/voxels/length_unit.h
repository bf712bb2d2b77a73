// Units of length as files spell them.
#pragma once

#include <optional>
#include <string_view>

#include "types/read_options.h"

namespace voxtet {

/// The millimetres of a unit, in any spelling that files use: "mm", "millimeters", "Micron", "µm". Nothing
/// for a word that is no unit of length.
std::optional<double> mm_per_length_unit(std::string_view name);

/// Those of the unit that the options say; nothing where they leave it to the file.
std::optional<double> mm_per_unit_of(const ReadOptions& options);

/// The end of a message about a unit.
inline constexpr const char* kSayUnit = "say it with --unit mm (source.unit: m, cm, mm, um or nm)";

}  // namespace voxtet
