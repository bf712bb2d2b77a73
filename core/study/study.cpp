#include "study/study.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "io/bytes/files.h"
#include "io/mesh/write_mesh.h"
#include "pipeline/case_files.h"
#include "study/volume_paths.h"

namespace voxtet {
namespace {

namespace fs = std::filesystem;
// Fields stand in the table in the order in which the study has them.
using Json = nlohmann::ordered_json;
using nlohmann::json;

constexpr std::size_t kMostCases = 100'000;

Error wrong(const std::string& what) {
  return usage_error("study", what);
}

json plain(const Json& value) {
  return json::parse(value.dump());
}

/// A value in a message, cut short.
std::string shown(const Json& value) {
  constexpr std::size_t kMost = 80;
  const std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  return text.size() <= kMost ? text : text.substr(0, kMost) + "...";
}

/// The study as it is written, before cases are formed.
struct Draft {
  Recipe recipe;
  std::vector<std::string> volumes;  ///< paths from the study's folder
  std::optional<Cohort> cohort;
  std::vector<std::pair<std::string, std::vector<json>>> grid;
  std::vector<NamedChange> list;
};

Status check_fields(const Json& object, const std::string& where, const std::vector<std::string>& known) {
  if (!object.is_object()) return wrong(where + ": found " + shown(object) + ", expected an object");
  for (const auto& [name, value] : object.items())
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      std::string fields;
      for (const std::string& one : known) fields += (fields.empty() ? "" : ", ") + one;
      return wrong(where + ": found the field " + name + ", expected some of " + fields);
    }
  return std::monostate{};
}

Result<std::vector<std::string>> texts_of(const Json& object, const std::string& field) {
  std::vector<std::string> texts;
  if (!object.contains(field)) return texts;
  const Json& value = object[field];
  const bool fits = value.is_array() && std::all_of(value.begin(), value.end(), [](const Json& text) {
                      return text.is_string() && !text.get_ref<const std::string&>().empty();
                    });
  if (!fits) return wrong(field + ": found " + shown(value) + ", expected a list of texts");
  for (const Json& text : value) texts.push_back(text);
  return texts;
}

Status read_case_of(const Json& object, const std::string& folder, Draft& draft, StudyPlan& plan) {
  if (!object.contains("case"))
    return wrong("case: found none, expected a recipe, or the path of a case file");
  const Json& value = object["case"];
  if (value.is_string()) {
    const fs::path path = fs::path(folder) / value.get<std::string>();
    Result<Recipe> recipe = read_case_file(path.string());
    if (!recipe) return recipe.error();
    draft.recipe = *recipe;
    plan.folder = path.parent_path().string();
    return std::monostate{};
  }
  Result<Recipe> recipe = parse_recipe(plain(value));
  if (!recipe) return wrong("case: " + recipe.error().message);
  draft.recipe = *recipe;
  plan.folder = folder;
  return std::monostate{};
}

Status read_volumes(const Json& object, const std::string& folder, Draft& draft) {
  const Result<std::vector<std::string>> patterns = texts_of(object, "volumes");
  if (!patterns) return patterns.error();
  for (const std::string& pattern : *patterns) {
    const Result<std::vector<std::string>> paths = volumes_like(folder, pattern);
    if (!paths) return paths.error();
    draft.volumes.insert(draft.volumes.end(), paths->begin(), paths->end());
  }
  return std::monostate{};
}

Status read_cohort(const Json& object, Draft& draft) {
  if (!object.contains("cohort")) return std::monostate{};
  const Json& value = object["cohort"];
  if (Status known = check_fields(value, "cohort", {"hearts", "seed", "draw"}); !known) return known;
  if (!draft.volumes.empty()) return wrong("cohort: found volumes too, expected one or the other");
  const auto whole = [&](const char* field, std::uint64_t least, std::uint64_t most) {
    return value.contains(field) && value[field].is_number_unsigned() && value[field] >= least &&
           value[field] <= most;
  };
  if (!whole("hearts", 1, kMostCases))
    return wrong("cohort.hearts: found " + (value.contains("hearts") ? shown(value["hearts"]) : "none") +
                 ", expected a whole number from 1 to " + std::to_string(kMostCases));
  Cohort cohort{.hearts = value["hearts"]};
  if (value.contains("seed")) {
    if (!whole("seed", 0, std::numeric_limits<std::uint32_t>::max()))
      return wrong("cohort.seed: found " + shown(value["seed"]) + ", expected a whole number from 0");
    cohort.seed = value["seed"];
  }
  if (value.contains("draw")) {
    if (!value["draw"].is_object())
      return wrong("cohort.draw: found " + shown(value["draw"]) +
                   R"(, expected {"source.phantom.scale": {...}})");
    for (const auto& [field, from] : value["draw"].items()) {
      Result<Draw> draw = parse_draw(field, plain(from));
      if (!draw) return draw.error();
      cohort.draws.push_back(*std::move(draw));
    }
  }
  draft.cohort = std::move(cohort);
  return std::monostate{};
}

Status read_grid(const Json& object, Draft& draft) {
  if (!object.contains("grid")) return std::monostate{};
  if (!object["grid"].is_object())
    return wrong("grid: found " + shown(object["grid"]) + R"(, expected {"sizing.edge_mm": [2, 3]})");
  for (const auto& [field, values] : object["grid"].items()) {
    if (!values.is_array() || values.empty())
      return wrong("grid." + field + ": found " + shown(values) + ", expected a list of values");
    draft.grid.emplace_back(field, plain(values).get<std::vector<json>>());
  }
  return std::monostate{};
}

Status read_list(const Json& object, Draft& draft) {
  if (!object.contains("list")) return std::monostate{};
  if (!object["list"].is_array() || object["list"].empty())
    return wrong("list: found " + shown(object["list"]) + ", expected a list of changes");
  std::set<std::string> names;
  for (const Json& entry : object["list"]) {
    const std::string where = "list[" + std::to_string(draft.list.size()) + "]";
    if (Status known = check_fields(entry, where, {"name", "set"}); !known) return known;
    if (!entry.contains("name") || !entry["name"].is_string() || !entry.contains("set") ||
        !entry["set"].is_object())
      return wrong(where + ": found " + shown(entry) +
                   R"(, expected {"name": "coarse", "set": {"sizing.edge_mm": 3}})");
    NamedChange change{.name = entry["name"]};
    if (!names.insert(change.name).second)
      return wrong(where + ".name: found " + change.name + " twice, expected it once");
    for (const auto& [field, value] : entry["set"].items()) change.set.emplace_back(field, plain(value));
    draft.list.push_back(std::move(change));
  }
  return std::monostate{};
}

Status read_plan(const Json& object, StudyPlan& plan) {
  const Result<std::vector<std::string>> stages = texts_of(object, "stages"), keep = texts_of(object, "keep");
  if (!stages) return stages.error();
  for (const std::string& name : *stages) {
    const Result<Stage> stage = stage_of(name);
    if (!stage) return wrong("stages: " + stage.error().message);
    plan.stages.push_back(*stage);
  }
  if (plan.stages.empty()) plan.stages = {Stage::kQuality};
  if (!keep) return keep.error();
  for (const std::string& ending : *keep) {
    const auto is_word = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); };
    if (!std::all_of(ending.begin(), ending.end(), is_word))
      return wrong("keep: found " + shown(ending) +
                   ", expected an ending without the dot, as vtu, or report");
    if (ending != "report")
      if (const Result<MeshFormat> format = mesh_format_of("mesh." + ending); !format)
        return wrong("keep: " + format.error().message + "; or report");
    const auto gives_mesh = [](Stage stage) {
      return stage == Stage::kOptimise || needs(stage, Stage::kOptimise);
    };
    if (ending != "report" && std::none_of(plan.stages.begin(), plan.stages.end(), gives_mesh))
      return wrong("keep: found " + ending +
                   ", a mesh, which none of the stages makes; expected quality among them");
    plan.keep.push_back(ending);
  }
  return std::monostate{};
}

std::string text_of_value(const json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// Fields that two parts of a study set: one would win in silence.
Status check_set_once(const Draft& draft) {
  std::map<std::string, std::string> setters;
  const auto set = [&](const std::string& field, const std::string& by) {
    const auto [entry, is_new] = setters.try_emplace(field, by);
    if (is_new || entry->second == by) return Status(std::monostate{});
    return Status(
        wrong(by + ": found " + field + ", which " + entry->second + " sets too; expected one of them"));
  };
  if (draft.cohort)
    for (const Draw& draw : draft.cohort->draws)
      if (Status once = set(draw.field, "cohort.draw"); !once) return once;
  for (const NamedChange& change : draft.list)
    for (const auto& [field, value] : change.set)
      if (Status once = set(field, "list"); !once) return once;
  for (const auto& [field, values] : draft.grid)
    if (Status once = set(field, "grid"); !once) return once;
  return std::monostate{};
}

/// A case with one field more.
Status vary(StudyCase& one, const std::string& field, const json& value) {
  Result<Recipe> changed = with_field(one.recipe, field, value.dump());
  if (!changed) return wrong(changed.error().message);
  one.recipe = *std::move(changed);
  one.varied.emplace_back(field, value);
  return std::monostate{};
}

void add_to_name(StudyCase& one, const std::string& text) {
  one.name += (one.name.empty() ? "" : ", ") + text;
}

/// A case for each source.
Result<std::vector<StudyCase>> cases_of_sources(const Draft& draft, const std::string& study_folder) {
  std::vector<StudyCase> cases;
  for (const std::string& path : draft.volumes) {
    StudyCase one{.recipe = draft.recipe, .volume_path = (fs::path(study_folder) / path).string()};
    one.recipe.source.phantom.reset();
    one.recipe.source.inlined.reset();
    one.recipe.source.file = FileSource{.name = fs::path(path).filename().string()};
    one.name = path;
    one.varied.emplace_back("source.file", one.name);
    cases.push_back(std::move(one));
  }
  for (std::size_t heart = 1; draft.cohort && heart <= draft.cohort->hearts; ++heart) {
    Result<DrawnHeart> drawn = draw_heart(draft.recipe, *draft.cohort, heart);
    if (!drawn) return drawn.error();
    StudyCase one{.name = "heart " + std::to_string(heart), .recipe = drawn->recipe};
    one.varied = std::move(drawn->drawn);
    cases.push_back(std::move(one));
  }
  if (cases.empty()) cases.push_back({.recipe = draft.recipe});
  return cases;
}

/// Whether there may be so many times as many cases.
Status check_count(std::size_t cases, std::size_t times, const std::string& where) {
  if (cases <= kMostCases / times) return std::monostate{};
  return wrong(where + ": found more than " + std::to_string(kMostCases) + " cases in all, expected fewer");
}

Result<std::vector<StudyCase>> with_list(std::vector<StudyCase> cases, const std::vector<NamedChange>& list) {
  if (list.empty()) return cases;
  if (Status few = check_count(cases.size(), list.size(), "list"); !few) return few.error();
  std::vector<StudyCase> out;
  for (const StudyCase& one : cases)
    for (const NamedChange& change : list) {
      StudyCase changed = one;
      for (const auto& [field, value] : change.set) {
        Result<Recipe> recipe = with_field(changed.recipe, field, value.dump());
        if (!recipe) return wrong("list, " + change.name + ": " + recipe.error().message);
        changed.recipe = *std::move(recipe);
      }
      changed.varied.emplace_back("change", change.name);
      add_to_name(changed, change.name);
      out.push_back(std::move(changed));
    }
  return out;
}

Result<std::vector<StudyCase>> with_grid(std::vector<StudyCase> cases, const Draft& draft) {
  for (const auto& [field, values] : draft.grid) {
    if (Status few = check_count(cases.size(), values.size(), "grid"); !few) return few.error();
    std::vector<StudyCase> out;
    for (const StudyCase& one : cases)
      for (const json& value : values) {
        StudyCase changed = one;
        if (Status varied = vary(changed, field, value); !varied)
          return wrong("grid: " + varied.error().message);
        add_to_name(changed, field + " " + text_of_value(value));
        out.push_back(std::move(changed));
      }
    cases = std::move(out);
  }
  return cases;
}

Result<std::vector<StudyCase>> cases_of(const Draft& draft, const StudyPlan& plan) {
  if (Status once = check_set_once(draft); !once) return once.error();
  Result<std::vector<StudyCase>> cases = cases_of_sources(draft, plan.study_folder);
  if (cases) cases = with_list(*std::move(cases), draft.list);
  if (cases) cases = with_grid(*std::move(cases), draft);
  if (!cases) return cases;
  for (std::size_t i = 0; i < cases->size(); ++i) {
    StudyCase& one = (*cases)[i];
    one.number = i + 1;
    one.recipe.expected = {};
    if (one.name.empty()) one.name = "case";
    const Source& source = one.recipe.source;
    if (!source.phantom && !source.inlined && !source.file)
      return wrong("case.source: found none, expected one, or volumes");
    const auto simulates = [](Stage stage) { return stage > Stage::kQuality; };
    if (!one.recipe.physics && std::any_of(plan.stages.begin(), plan.stages.end(), simulates))
      return wrong("stages: found a simulation, and no physics in the recipe; expected case.physics");
    if (source.file && one.volume_path.empty())
      one.volume_path = (fs::path(plan.folder) / source.file->name).string();
  }
  return cases;
}

}  // namespace

Result<Study> read_study(const std::string& path) {
  const Result<Bytes> bytes = read_file(path);
  if (!bytes) return bytes.error();
  const auto named = [&](Error error) {
    error.message = path + ": " + error.message;
    return error;
  };
  Json object;
  try {
    object = Json::parse(bytes->begin(), bytes->end());
  } catch (const Json::exception& error) {
    return named(wrong(std::string("found no JSON, expected a study: ") + error.what()));
  }
  if (Status known = check_fields(
          object, "study", {"study", "title", "case", "volumes", "cohort", "grid", "list", "stages", "keep"});
      !known)
    return named(known.error());
  if (!object.contains("study") || object["study"] != 1)
    return named(wrong("study: found " + (object.contains("study") ? shown(object["study"]) : "none") +
                       ", expected 1, the version of its form"));
  if (object.contains("title") && !object["title"].is_string())
    return named(wrong("title: found " + shown(object["title"]) + ", expected a text"));
  Study study;
  study.title = object.value("title", fs::path(path).stem().string());
  const std::string folder = fs::path(path).parent_path().string();
  study.plan.study_folder = folder;
  Draft draft;
  Status read = read_case_of(object, folder, draft, study.plan);
  if (read) read = read_volumes(object, folder, draft);
  if (read) read = read_cohort(object, draft);
  if (read) read = read_list(object, draft);
  if (read) read = read_grid(object, draft);
  if (read) read = read_plan(object, study.plan);
  if (!read) return named(read.error());
  Result<std::vector<StudyCase>> cases = cases_of(draft, study.plan);
  if (!cases) return named(cases.error());
  study.cases = *std::move(cases);
  return study;
}

}  // namespace voxtet
