#include "cli/case_input.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "io/files.h"
#include "recipe/link.h"
#include "volume/select_labels.h"

namespace voxtet {
namespace {

Error usage(const std::string& message) {
  return {ErrorCode::kUsage, "cli", message, {}};
}

bool is_case_file(const std::string& input) {
  return input.size() > 5 && input.ends_with(".json");
}

Status load_file(const std::string& path, Session& session) {
  Result<Bytes> bytes = read_file(path);
  if (!bytes) return bytes.error();
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const SiblingReader sibling = [folder](const std::string& name) {
    return read_file((folder / name).string());
  };
  return session.load_volume({std::filesystem::path(path).filename().string(), *bytes, sibling});
}

/// "a=b" -> {a, b}. Errors: kUsage.
Result<std::pair<std::string, std::string>> split_pair(const std::string& option, const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0) return usage(option + " " + text + ": expected NAME=VALUE");
  return std::pair{text.substr(0, at), text.substr(at + 1)};
}

Result<double> to_number(const std::string& option, const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0') return usage(option + ": found '" + text + "', expected a number");
  return value;
}

/// "1,5,6" -> [1, 5, 6]. Errors: kUsage.
Result<nlohmann::json> to_group(const std::string& text) {
  const nlohmann::json group = nlohmann::json::parse("[" + text + "]", nullptr, false);
  const bool whole = !group.is_discarded() && std::all_of(group.begin(), group.end(), [](const auto& label) {
    return label.is_number_unsigned();
  });
  if (!whole) return usage("--merge " + text + ": expected labels as 1,5,6, and the input before it");
  return group;
}

bool merges_all(const CaseOptions& options) {
  return std::find(options.merge.begin(), options.merge.end(), "") != options.merge.end();
}

/// The labels that the case meshes, as one group. Runs the volume stage where the case does not name them.
Result<LabelGroup> group_of_all(const Recipe& recipe, Session& session) {
  if (!recipe.labels.empty()) return recipe.labels;
  if (Status set = session.set_recipe(recipe); !set) return set.error();
  RunContext ctx;
  if (Status ran = session.run(Stage::kVolume, ctx); !ran) return ran.error();
  LabelGroup group;
  for (const auto& [label, count] : count_labels(*session.source_volume())) group.push_back(label);
  return group;
}

Result<Recipe> with_options(Recipe recipe, const CaseOptions& options) {
  nlohmann::json json = recipe_to_json(recipe);
  if (!options.labels.empty()) json["labels"] = options.labels;
  if (!options.look_up.empty()) json["lookup"]["labels"] = options.look_up;
  if (merges_all(options) && options.merge.size() > 1)
    return usage("--merge: found all labels and " + std::to_string(options.merge.size() - 1) +
                 " more groups, expected one or the other");
  if (!options.merge.empty()) json["merge"] = nlohmann::json::array();
  for (const std::string& text : options.merge) {
    if (text.empty()) continue;
    Result<nlohmann::json> group = to_group(text);
    if (!group) return group.error();
    json["merge"].push_back(std::move(group).value());
  }
  if (options.edge_mm != 0) json["sizing"]["edge_mm"] = options.edge_mm;
  for (const std::string& text : options.edge_labels) {
    auto pair = split_pair("--edge-label", text);
    if (!pair) return pair.error();
    Result<double> label = to_number("--edge-label " + text, pair->first);
    if (!label) return label.error();
    Result<double> edge = to_number("--edge-label " + text, pair->second);
    if (!edge) return edge.error();
    nlohmann::json& sizes = json["sizing"]["labels"];
    std::erase_if(sizes.get_ref<nlohmann::json::array_t&>(),
                  [&](const auto& s) { return s["label"] == *label; });
    sizes.push_back({{"label", *label}, {"edge_mm", *edge}});
  }
  Result<Recipe> changed = parse_recipe(json);
  for (const std::string& text : options.set) {
    if (!changed) return changed;
    auto pair = split_pair("--set", text);
    if (!pair) return pair.error();
    changed = with_field(*changed, pair->first, pair->second);
  }
  return changed;
}

}  // namespace

Result<Recipe> read_case(const std::string& input) {
  if (is_link(input)) return recipe_of_link(input);
  if (!is_case_file(input)) return Recipe{};
  Result<Bytes> bytes = read_file(input);
  if (!bytes) return bytes.error();
  Result<Recipe> recipe =
      parse_recipe(std::string_view(reinterpret_cast<const char*>(bytes->data()), bytes->size()));
  if (!recipe) {
    Error error = recipe.error();
    error.message = input + ": " + error.message;
    return error;
  }
  return recipe;
}

Status open_case(const CaseOptions& options, Session& session) {
  Result<Recipe> recipe = read_case(options.input);
  if (!recipe) return recipe.error();
  std::string path;
  if (!is_link(options.input) && !is_case_file(options.input)) {
    path = options.input;
  } else if (recipe->source.file) {
    path = recipe->source.file->name;
    if (is_case_file(options.input))
      path = (std::filesystem::path(options.input).parent_path() / path).string();
  }
  if (!path.empty()) {
    if (Status loaded = load_file(path, session); !loaded) return loaded;
    if (!recipe->source.file) recipe->source = session.recipe().source;
  }
  Result<Recipe> changed = with_options(std::move(recipe).value(), options);
  if (!changed) return changed.error();
  if (merges_all(options)) {
    Result<LabelGroup> group = group_of_all(*changed, session);
    if (!group) return group.error();
    changed->merge = {std::move(group).value()};
  }
  return session.set_recipe(*changed);
}

}  // namespace voxtet
