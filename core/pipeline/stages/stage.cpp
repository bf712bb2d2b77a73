#include "pipeline/stages/stage.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/digest.h"
#include "pipeline/version/engine_version.h"

namespace voxtet {
namespace {

using nlohmann::json;

/// What stands at "group.field" or, for each entry, at "group.list[].field"; null where it is absent.
json part_of(const json& value, std::string_view path) {
  if (path.empty()) return value;
  const std::size_t end = path.find_first_of(".[");
  const std::string name(path.substr(0, end));
  const auto found = value.find(name);
  if (found == value.end()) return nullptr;
  if (end == std::string_view::npos) return *found;
  if (path[end] == '.') return part_of(*found, path.substr(end + 1));
  constexpr std::string_view kEach = "[].";
  json parts = json::array();
  for (const json& entry : *found) parts.push_back(part_of(entry, path.substr(end + kEach.size())));
  return parts;
}

std::string hashed(const std::string& text) {
  Sha256 sha;
  sha.update(text);
  return sha.hex();
}

}  // namespace

bool has_place(Stage stage, const Recipe& recipe, const LoadedFiles& files) {
  return !opened_mesh(recipe, files) || stage < Stage::kSurface || stage > Stage::kTetra;
}

std::vector<Stage> inputs_of(Stage stage, const Recipe& recipe, const LoadedFiles& files) {
  std::vector<Stage> inputs;
  const StageSpec& spec = spec_of(stage);
  for (const Stage input : spec.inputs)
    if (has_place(input, recipe, files) && (!spec.wants || spec.wants(input, recipe)))
      inputs.push_back(input);
  return inputs;
}

bool needs(Stage stage, Stage input) {
  const std::vector<Stage>& inputs = spec_of(stage).inputs;
  return stage == input ||
         std::any_of(inputs.begin(), inputs.end(), [&](Stage other) { return needs(other, input); });
}

Result<Stimulus> StageTask::stimulate(Stimulus) {
  return usage_error("session", "the stage under way takes no stimulus");
}

Status StageTask::resume(const Bytes&) {
  return usage_error("session", "this stage cannot go on from a saved state");
}

Result<Stage> stage_of(std::string_view name) {
  std::string names;
  for (const StageSpec& spec : stage_table()) {
    if (spec.name == name) return spec.stage;
    names += (names.empty() ? "" : ", ") + std::string(spec.name);
  }
  return usage_error("session", "no stage '" + std::string(name) + "'; the stages are " + names);
}

std::string fields_text(const json& recipe, const std::vector<std::string_view>& paths) {
  std::string text;
  for (const std::string_view path : paths) text += part_of(recipe, path).dump() + "\n";
  return text;
}

StageKeys keys_of(const Recipe& recipe, const LoadedFiles& files) {
  const json fields = recipe_to_json(recipe);
  StageKeys keys;
  for (const StageSpec& spec : stage_table()) {
    std::string key = engine_version() + " " + std::string(spec.name) + "\n";
    for (const Stage input : inputs_of(spec.stage, recipe, files))
      key += keys[static_cast<std::size_t>(input)] + "\n";
    key += fields_text(fields, spec.reads);
    if (spec.add_files) spec.add_files(files, recipe, key);
    keys[static_cast<std::size_t>(spec.stage)] = hashed(key);
  }
  return keys;
}

json stages_schema() {
  json out = json::array();
  for (const StageSpec& spec : stage_table()) {
    json inputs = json::array();
    for (const Stage input : spec.inputs) inputs.push_back(spec_of(input).name);
    out.push_back({{"name", spec.name},
                   {"title", spec.title},
                   {"shown", spec.shown},
                   {"inputs", inputs},
                   {"reads", spec.reads},
                   {"in_steps", spec.start != nullptr}});
  }
  return out;
}

}  // namespace voxtet
