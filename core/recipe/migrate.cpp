#include "recipe/migrate.h"

#include <nlohmann/json.hpp>
#include <string_view>

namespace voxtet {
namespace {

using nlohmann::json;

/// What version 1 called otherwise.
constexpr std::string_view kLookup = "lookup", kTransfer = "transfer";
constexpr std::string_view kMethod = "remesh.method", kFormerAdapt = "remesh", kAdapt = "adapt";

Result<json> from_version_1(json recipe) {
  if (const auto lookup = recipe.find(kLookup); lookup != recipe.end()) {
    if (recipe.contains(kTransfer))
      return usage_error("recipe",
                         "lookup: found beside transfer, which is its name today; expected one of them");
    json group = std::move(*lookup);
    recipe.erase(lookup);
    recipe[kTransfer] = std::move(group);
  }
  const json::json_pointer method("/remesh/method");
  if (recipe.contains(method) && recipe[method] == kFormerAdapt) recipe[method] = kAdapt;
  recipe["version"] = 2;
  return recipe;
}

}  // namespace

Result<json> migrated(const json& recipe) {
  // What is no object is the reader's to refuse.
  if (!recipe.is_object()) return recipe;
  int version = 1;
  if (const auto said = recipe.find("version"); said != recipe.end()) {
    if (!said->is_number_integer() || *said < 1)
      return usage_error("recipe",
                         "version: found " + said->dump(-1, ' ', false, json::error_handler_t::replace) +
                             ", expected a whole number from 1 to " + std::to_string(kRecipeVersion));
    if (*said > kRecipeVersion)
      return usage_error("recipe",
                         "version: found " + said->dump() + ", a recipe of a later voxtet; expected " +
                             std::to_string(kRecipeVersion) + " or less: open it with a newer voxtet");
    version = said->get<int>();
  }
  return version == 1 ? from_version_1(recipe) : recipe;
}

void migrate_field(std::string& path, json& value) {
  if (path.substr(0, path.find('.')) == kLookup) path.replace(0, kLookup.size(), kTransfer);
  if (path == kMethod && value == kFormerAdapt) value = kAdapt;
}

}  // namespace voxtet
