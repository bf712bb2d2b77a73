// Versions of the recipe's format: what an earlier one called otherwise is brought to the names of today.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "types/result.h"

namespace voxtet {

/// The version that is written today. To be raised, with a step in migrate.cpp, whenever a field is renamed,
/// moved, or comes to mean something else.
inline constexpr int kRecipeVersion = 2;

/// A recipe as its present version writes it, with its field `version`. One without this field is of the
/// first. Errors: kUsage (of a later version than this engine knows; a field beside its own former name).
Result<nlohmann::json> migrated(const nlohmann::json& recipe);

/// The path and the value of a single field likewise, for those who name it as version 1 did.
void migrate_field(std::string& path, nlohmann::json& value);

}  // namespace voxtet
