#include "cli/input/case_input.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "cli/words/label_words.h"
#include "cli/words/option_texts.h"
#include "io/bytes/files.h"
#include "pipeline/case_files.h"
#include "pipeline/sources/source_volume.h"
#include "recipe/link.h"
#include "volume/clean/clean_volume.h"

namespace voxtet {
namespace {

/// The name of a file that has none.
constexpr const char* kStandardInput = "stdin";

bool is_case_file(const std::string& input) {
  return input.size() > 5 && input.ends_with(".json");
}

/// Where the files are that the case file names, if there is one.
std::string folder_of(const CaseOptions& options) {
  if (!is_case_file(options.input)) return "";
  return std::filesystem::path(options.input).parent_path().string();
}

/// What a recipe calls the file of a path.
std::string file_name(const std::string& path) {
  return path == kDash ? kStandardInput : std::filesystem::path(path).filename().string();
}

/// "5=0.8mm" of each text -> {"label": 5, "edge_mm": 0.8}. Errors: kUsage.
Result<nlohmann::json> to_edges(const std::string& option, const std::vector<std::string>& texts,
                                const LabelWords& words) {
  nlohmann::json edges = nlohmann::json::array();
  std::set<Label> sized;
  for (const std::string& text : texts) {
    const auto pair = split_pair(option, text, "LABEL=LENGTH, as 5=0.8");
    if (!pair) return pair.error();
    const Result<std::vector<Label>> labels = words.labels_of(option + " " + text, pair->first);
    if (!labels) return labels.error();
    const Result<double> edge = to_mm(option + " " + text, pair->second);
    if (!edge) return edge.error();
    for (const Label label : *labels) {
      if (!sized.insert(label).second)
        return usage_error("cli",
                           option + ": found label " + std::to_string(label) + " twice, expected once");
      edges.push_back({{"label", label}, {"edge_mm", *edge}});
    }
  }
  return edges;
}

/// The labels of all texts, each once. Errors: kUsage.
Result<std::vector<Label>> to_labels(const std::string& option, const std::vector<std::string>& texts,
                                     const LabelWords& words) {
  std::vector<Label> all;
  for (const std::string& text : texts) {
    const Result<std::vector<Label>> labels = words.labels_of(option, text);
    if (!labels) return labels.error();
    for (const Label label : *labels)
      if (std::find(all.begin(), all.end(), label) == all.end()) all.push_back(label);
  }
  return all;
}

/// "Wall,1-3:0,0,40:0,0,1:base" -> {"labels": ..., "point_mm": ..., "normal": ..., "name": ...}. Errors:
/// kUsage.
Result<nlohmann::json> to_cut(const std::string& text, const LabelWords& words) {
  const std::vector<std::string> parts = split(text, ':');
  const auto unlike = [&](const std::string& found) {
    return usage_error("cli", "--cut " + text + ": found " + found +
                                  ", expected LABELS:X,Y,Z:NX,NY,NZ or LABELS:X,Y,Z:NX,NY,NZ:NAME, as "
                                  "all:0,0,40:0,0,1:base");
  };
  if (parts.size() != 3 && parts.size() != 4) return unlike(std::to_string(parts.size()) + " parts");
  nlohmann::json cut = nlohmann::json::object();
  if (parts[0] != "all") {
    const Result<std::vector<Label>> labels = words.labels_of("--cut " + text, parts[0]);
    if (!labels) return labels.error();
    cut["labels"] = *labels;
  }
  for (const std::size_t part : {1, 2}) {
    const std::optional<std::array<double, 3>> numbers = three_numbers(parts[part]);
    if (!numbers) return unlike("'" + parts[part] + "'");
    cut[part == 1 ? "point_mm" : "normal"] = *numbers;
  }
  if (parts.size() == 4) cut["name"] = parts[3];
  return cut;
}

/// Reads a file, or standard input for "-", and gives it to `load`. `format`: the ending of one without a
/// name.
Status open_input(const std::string& path, const std::string& format, const LoadFile& load) {
  const Result<Bytes> bytes = read_input(path);
  if (!bytes) return bytes.error();
  VolumeFile file = file_at(path, *bytes);
  file.name = file_name(path) + (format.empty() ? "" : "." + format);
  return load(file);
}

/// The masks and images of the case, beside it, and those of the options.
SidePaths side_paths_of(const Recipe& recipe, const CaseOptions& options) {
  SidePaths paths{options.masks, options.size_images};
  const auto [masks, images] = side_paths(recipe, folder_of(options));
  paths.masks.insert(paths.masks.end(), masks.begin(), masks.end());
  paths.images.insert(paths.images.end(), images.begin(), images.end());
  return paths;
}

bool merges_all(const CaseOptions& options) {
  return std::find(options.merge.begin(), options.merge.end(), "") != options.merge.end();
}

bool names_labels(const CaseOptions& options) {
  return !options.labels.empty() || !options.merge.empty() || !options.transfer.empty() ||
         !options.edge_labels.empty() || !options.cut.empty();
}

/// The volume in which names of labels are looked up: what was loaded, else what the recipe itself gives.
Result<std::shared_ptr<const LabelVolume>> volume_of(const Recipe& recipe, const Session& session) {
  if (session.files().volume) return session.files().volume;
  if (needs_file(recipe.source)) return std::shared_ptr<const LabelVolume>();  // a run says what is missing
  Result<LabelVolume> made = make_volume(recipe.source);
  if (!made) return made.error();
  return std::make_shared<const LabelVolume>(std::move(made).value());
}

/// Puts the options for labels into a recipe.
Status put_labels(const CaseOptions& options, const LabelWords& words, nlohmann::json& json) {
  const Result<std::vector<Label>> labels = to_labels("--labels", options.labels, words);
  if (!labels) return labels.error();
  if (!labels->empty()) json["labels"] = *labels;
  const Result<std::vector<Label>> transfer = to_labels("--transfer", options.transfer, words);
  if (!transfer) return transfer.error();
  if (!transfer->empty()) json["transfer"]["labels"] = *transfer;
  if (merges_all(options) && options.merge.size() > 1)
    return usage_error("cli", "--merge: found all labels and " + std::to_string(options.merge.size() - 1) +
                                  " more groups, expected one or the other");
  if (!options.merge.empty()) json["merge"] = nlohmann::json::array();
  for (const std::string& text : options.merge) {
    // All of them are those that the case meshes.
    const bool of_case = text.empty() && !json["labels"].empty();
    const Result<std::vector<Label>> group = words.labels_of("--merge", text.empty() ? "all" : text);
    if (!group) return group.error();
    if (of_case)
      json["merge"].push_back(json["labels"]);
    else if (!group->empty())
      json["merge"].push_back(*group);
  }
  const Result<nlohmann::json> edges = to_edges("--edge-label", options.edge_labels, words);
  if (!edges) return edges.error();
  for (const nlohmann::json& edge : *edges) {
    nlohmann::json& sizes = json["sizing"]["labels"];
    std::erase_if(sizes.get_ref<nlohmann::json::array_t&>(),
                  [&](const auto& s) { return s["label"] == edge["label"]; });
    sizes.push_back(edge);
  }
  return std::monostate{};
}

/// Usual cleaning, where the recipe asks for none of a kind.
void put_cleaning(nlohmann::json& volume) {
  const nlohmann::json preset = cleaning_preset();
  for (const auto& [field, voxels] : preset["volume"].items())
    if (volume[field] == 0) volume[field] = voxels;
}

/// The recipe with the options. Before its volume is known, names and ranges of labels are left out.
Result<Recipe> with_options(const Recipe& recipe, const CaseOptions& options, const LabelVolume* volume) {
  nlohmann::json json = recipe_to_json(recipe);
  put_read_options(options.read, json["source"]);
  const LabelWords words(volume, recipe.legend);
  if (Status put = put_labels(options, words, json); !put) return put.error();
  for (const std::string& text : options.cut) {
    const Result<nlohmann::json> cut = to_cut(text, words);
    if (!cut) return cut.error();
    json["volume"]["cut"].push_back(*cut);
  }
  if (options.clean) put_cleaning(json["volume"]);
  if (options.edge_mm) {
    const Result<double> edge = to_mm("--edge-mm", *options.edge_mm);
    if (!edge) return edge.error();
    json["sizing"]["edge_mm"] = *edge;
  }
  if (options.stack) json.merge_patch(thick_stack_preset());
  if (options.align_slices) json["volume"]["align_slices"] = true;
  // The names of labels are the input's, not the masks'.
  const Result<nlohmann::json> mask_edges = to_edges("--mask-edge", options.mask_edges, LabelWords(nullptr));
  if (!mask_edges) return mask_edges.error();
  for (const std::string& text : options.mask_edges)
    if (text.find_first_not_of("0123456789,") < text.find('='))
      return usage_error("cli", "--mask-edge " + text + ": expected labels of the mask by number, as 1=0.8");
  if (!options.mask_edges.empty() && options.masks.empty())
    return usage_error(
        "cli", "--mask-edge " + options.mask_edges[0] + ": found no --mask, expected one that it sizes");
  for (const std::string& path : options.masks)
    json["sizing"]["masks"].push_back({{"name", file_name(path)}, {"edges", *mask_edges}});
  for (const std::string& path : options.size_images)
    json["sizing"]["images"].push_back({{"name", file_name(path)}});
  Result<Recipe> changed = parse_recipe(json);
  for (const std::string& text : options.set) {
    if (!changed) return changed;
    auto pair = split_pair("--set", text, "NAME=VALUE, as sizing.gradation=0.2");
    if (!pair) return pair.error();
    changed = with_field(*changed, pair->first, pair->second);
  }
  return changed;
}

}  // namespace

Result<Bytes> read_input(const std::string& path) {
  return path == kDash ? read_standard_input() : read_file(path);
}

std::vector<NamedPath> inputs_of(const CaseOptions& options) {
  std::vector<NamedPath> inputs;
  for (const std::string& path : options.masks) inputs.push_back({"--mask", path});
  for (const std::string& path : options.size_images) inputs.push_back({"--size-image", path});
  if (is_link(options.input)) return inputs;
  inputs.push_back({"the input", options.input});
  const Result<Recipe> recipe = read_case(options.input);
  if (!is_case_file(options.input) || !recipe) return inputs;
  const std::string folder = folder_of(options);
  const auto add = [&](const std::string& path) { inputs.push_back({"the case " + options.input, path}); };
  if (recipe->source.file) add((std::filesystem::path(folder) / recipe->source.file->name).string());
  const auto [masks, images] = side_paths(*recipe, folder);
  for (const std::string& path : masks) add(path);
  for (const std::string& path : images) add(path);
  return inputs;
}

Result<Recipe> read_case(const std::string& input) {
  if (is_link(input)) return recipe_of_link(input);
  if (!is_case_file(input)) return Recipe{};
  return read_case_file(input);
}

Result<Expected> expected_of(const Recipe& recipe, const std::string& input) {
  if (!recipe.expected.digest.empty()) return recipe.expected;
  const std::string beside = (std::filesystem::path(input).parent_path() / "expected.json").string();
  if (is_link(input) || !std::filesystem::exists(beside))
    return Error{ErrorCode::kUsage,
                 "verify",
                 input + ": the case promises no digest (field expected.digest, or " + beside + ")",
                 {}};
  Result<Bytes> bytes = read_file(beside);
  if (!bytes) return bytes.error();
  const nlohmann::json value = nlohmann::json::parse(bytes->begin(), bytes->end(), nullptr, false);
  if (!value.is_object() || !value.contains("digest"))
    return Error{
        ErrorCode::kBadInput, "verify", beside + ": expected a JSON object with the text field digest", {}};
  nlohmann::json promise = nlohmann::json::object();
  for (const char* field : {"engine", "digest", "tets", "physics", "stages"})
    if (value.contains(field)) promise[field] = value[field];
  Result<Recipe> read = parse_recipe(nlohmann::json{{"expected", promise}});
  if (!read) return Error{ErrorCode::kBadInput, "verify", beside + ": " + read.error().message, {}};
  return read->expected;
}

Status open_case(const CaseOptions& options, Session& session) {
  if (!options.input_format.empty() && options.input != kDash)
    return usage_error("cli", "--input-format: found the input " + options.input +
                                  ", which has a name; expected - for standard input");
  Result<Recipe> recipe = read_case(options.input);
  if (!recipe) return recipe.error();
  std::string path;
  if (!is_link(options.input) && !is_case_file(options.input)) {
    path = options.input;
  } else if (recipe->source.file) {
    path = (std::filesystem::path(folder_of(options)) / recipe->source.file->name).string();
  }
  const bool is_volume = !path.empty() && !recipe->source.file;
  if (is_volume) recipe->source.file = FileSource{file_name(path), {}, {}};
  Result<Recipe> changed = with_options(*recipe, options, nullptr);
  if (!changed) return changed.error();
  if (!path.empty()) {
    const ReadOptions& read = changed->source.read;
    const auto load = [&](const VolumeFile& file) { return session.load_volume(file, read); };
    if (Status loaded = open_input(path, options.input_format, load); !loaded) return loaded;
    if (is_volume) recipe->source = session.recipe().source;
  }
  const auto open = [](const std::string& side, const LoadFile& load) { return open_input(side, "", load); };
  if (Status loaded = load_side_files(side_paths_of(*recipe, options), session, open); !loaded) return loaded;
  Result<std::shared_ptr<const LabelVolume>> volume = std::shared_ptr<const LabelVolume>();
  if (names_labels(options)) volume = volume_of(*changed, session);
  if (!volume) return volume.error();
  changed = with_options(*recipe, options, volume->get());
  if (!changed) return changed.error();
  return session.set_recipe(*changed);
}

}  // namespace voxtet
