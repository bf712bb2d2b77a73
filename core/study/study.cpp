#include "study/study.h"

#include <fnmatch.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "io/bytes/files.h"
#include "io/mesh/write_mesh.h"
#include "pipeline/case_files.h"

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

/// The study as it is written, before cases are formed.
struct Draft {
  Recipe recipe;
  std::vector<std::string> volumes;  ///< paths
  std::optional<Cohort> cohort;
  std::vector<std::pair<std::string, std::vector<json>>> grid;
  std::vector<NamedChange> list;
};

Status check_fields(const Json& object, const std::string& where, const std::vector<std::string>& known) {
  if (!object.is_object()) return wrong(where + ": found " + object.dump() + ", expected an object");
  for (const auto& [name, value] : object.items())
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      std::string fields;
      for (const std::string& one : known) fields += (fields.empty() ? "" : ", ") + one;
      return wrong(where + ": found the field " + name + ", expected some of " + fields);
    }
  return std::monostate{};
}

/// The files of a path, whose last part may have * and ?; sorted.
Result<std::vector<std::string>> matches(const std::string& folder, const std::string& pattern) {
  const fs::path whole = fs::path(folder) / pattern;
  const std::string name = whole.filename().string();
  if (name.find_first_of("*?[") == std::string::npos) return std::vector<std::string>{whole.string()};
  std::vector<std::string> found;
  std::error_code failed;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(whole.has_parent_path() ? whole.parent_path() : fs::path("."), failed))
    if (fnmatch(name.c_str(), entry.path().filename().c_str(), FNM_PERIOD) == 0)
      found.push_back((whole.parent_path() / entry.path().filename()).string());
  if (found.empty())
    return Error{
        ErrorCode::kBadInput, "study", "volumes: found no file " + whole.string() + ", expected some", {}};
  std::sort(found.begin(), found.end());
  return found;
}

Result<std::vector<std::string>> texts_of(const Json& object, const std::string& field) {
  std::vector<std::string> texts;
  if (!object.contains(field)) return texts;
  const Json& value = object[field];
  const bool fits = value.is_array() && std::all_of(value.begin(), value.end(), [](const Json& text) {
                      return text.is_string() && !text.get_ref<const std::string&>().empty();
                    });
  if (!fits) return wrong(field + ": found " + value.dump() + ", expected a list of texts");
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
    const Result<std::vector<std::string>> paths = matches(folder, pattern);
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
    return wrong("cohort.hearts: found " + (value.contains("hearts") ? value["hearts"].dump() : "none") +
                 ", expected a whole number from 1");
  Cohort cohort{.hearts = value["hearts"]};
  if (value.contains("seed")) {
    if (!whole("seed", 0, std::numeric_limits<std::uint32_t>::max()))
      return wrong("cohort.seed: found " + value["seed"].dump() + ", expected a whole number from 0");
    cohort.seed = value["seed"];
  }
  if (value.contains("draw")) {
    if (!value["draw"].is_object())
      return wrong("cohort.draw: found " + value["draw"].dump() +
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
    return wrong("grid: found " + object["grid"].dump() + R"(, expected {"sizing.edge_mm": [2, 3]})");
  for (const auto& [field, values] : object["grid"].items()) {
    if (!values.is_array() || values.empty())
      return wrong("grid." + field + ": found " + values.dump() + ", expected a list of values");
    draft.grid.emplace_back(field, plain(values).get<std::vector<json>>());
  }
  return std::monostate{};
}

Status read_list(const Json& object, Draft& draft) {
  if (!object.contains("list")) return std::monostate{};
  if (!object["list"].is_array() || object["list"].empty())
    return wrong("list: found " + object["list"].dump() + ", expected a list of changes");
  std::set<std::string> names;
  for (const Json& entry : object["list"]) {
    const std::string where = "list[" + std::to_string(draft.list.size()) + "]";
    if (Status known = check_fields(entry, where, {"name", "set"}); !known) return known;
    if (!entry.contains("name") || !entry["name"].is_string() || !entry.contains("set") ||
        !entry["set"].is_object())
      return wrong(where + ": found " + entry.dump() +
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
Result<std::vector<StudyCase>> cases_of_sources(const Draft& draft) {
  std::vector<StudyCase> cases;
  for (const std::string& path : draft.volumes) {
    StudyCase one{.recipe = draft.recipe, .volume_path = path};
    one.recipe.source.phantom.reset();
    one.recipe.source.inlined.reset();
    one.recipe.source.file = FileSource{.name = fs::path(path).filename().string()};
    one.name = one.recipe.source.file->name;
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

Result<std::vector<StudyCase>> with_list(std::vector<StudyCase> cases, const std::vector<NamedChange>& list) {
  if (list.empty()) return cases;
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
    if (cases.size() * values.size() > kMostCases)
      return wrong("grid: found more than " + std::to_string(kMostCases) + " cases, expected fewer");
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

Result<std::vector<StudyCase>> cases_of(const Draft& draft, const std::string& folder) {
  Result<std::vector<StudyCase>> cases = cases_of_sources(draft);
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
    if (source.file && one.volume_path.empty())
      one.volume_path = (fs::path(folder) / source.file->name).string();
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
  const Json object = Json::parse(bytes->begin(), bytes->end(), nullptr, false);
  if (object.is_discarded()) return named(wrong("found no JSON, expected a study"));
  if (Status known = check_fields(
          object, "study", {"study", "title", "case", "volumes", "cohort", "grid", "list", "stages", "keep"});
      !known)
    return named(known.error());
  if (!object.contains("study") || object["study"] != 1)
    return named(wrong("study: found " + (object.contains("study") ? object["study"].dump() : "none") +
                       ", expected 1, the version of its form"));
  if (object.contains("title") && !object["title"].is_string())
    return named(wrong("title: found " + object["title"].dump() + ", expected a text"));
  Study study;
  study.title = object.value("title", fs::path(path).stem().string());
  const std::string folder = fs::path(path).parent_path().string();
  Draft draft;
  Status read = read_case_of(object, folder, draft, study.plan);
  if (read) read = read_volumes(object, folder, draft);
  if (read) read = read_cohort(object, draft);
  if (read) read = read_list(object, draft);
  if (read) read = read_grid(object, draft);
  if (read) read = read_plan(object, study.plan);
  if (!read) return named(read.error());
  Result<std::vector<StudyCase>> cases = cases_of(draft, study.plan.folder);
  if (!cases) return named(cases.error());
  study.cases = *std::move(cases);
  return study;
}

}  // namespace voxtet
