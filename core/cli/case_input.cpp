#include "cli/case_input.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "io/bytes/files.h"
#include "recipe/link.h"
#include "volume/select_labels.h"

namespace voxtet {
namespace {

bool is_case_file(const std::string& input) {
  return input.size() > 5 && input.ends_with(".json");
}

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

/// Reads a file and gives it to `load`, a function of VolumeFile.
template <class Load>
Status load_file(const std::string& path, Load load) {
  Result<Bytes> bytes = read_file(path);
  if (!bytes) return bytes.error();
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const SiblingReader sibling = [folder](const std::string& name) {
    return read_file((folder / name).string());
  };
  return load(VolumeFile{file_name(path), *bytes, sibling});
}

/// "a=b" -> {a, b}. Errors: kUsage.
Result<std::pair<std::string, std::string>> split_pair(const std::string& option, const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0)
    return usage_error("cli", option + " " + text + ": expected NAME=VALUE");
  return std::pair{text.substr(0, at), text.substr(at + 1)};
}

Result<double> to_number(const std::string& option, const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value))
    return usage_error("cli", option + ": found '" + text + "', expected a number");
  return value;
}

/// "5=0.8" of each text -> {"label": 5, "edge_mm": 0.8}. Errors: kUsage.
Result<nlohmann::json> to_edges(const std::string& option, const std::vector<std::string>& texts) {
  nlohmann::json edges = nlohmann::json::array();
  for (const std::string& text : texts) {
    auto pair = split_pair(option, text);
    if (!pair) return pair.error();
    Result<double> label = to_number(option + " " + text, pair->first);
    if (!label) return label.error();
    Result<double> edge = to_number(option + " " + text, pair->second);
    if (!edge) return edge.error();
    edges.push_back({{"label", *label}, {"edge_mm", *edge}});
  }
  return edges;
}

/// "1,5,6" -> [1, 5, 6]. Errors: kUsage.
Result<nlohmann::json> to_group(const std::string& text) {
  const nlohmann::json group = nlohmann::json::parse("[" + text + "]", nullptr, false);
  const bool whole = !group.is_discarded() && std::all_of(group.begin(), group.end(), [](const auto& label) {
    return label.is_number_unsigned();
  });
  if (!whole)
    return usage_error("cli", "--merge " + text + ": expected labels as 1,5,6, and the input before it");
  return group;
}

/// The masks and images of the case, beside it, and those of the options.
Status load_side_files(const Recipe& recipe, const CaseOptions& options, Session& session) {
  const std::filesystem::path folder = is_case_file(options.input)
                                           ? std::filesystem::path(options.input).parent_path()
                                           : std::filesystem::path();
  std::vector<std::string> masks = options.masks, images = options.size_images;
  for (const MaskSize& mask : recipe.sizing.masks) masks.push_back((folder / mask.name).string());
  for (const ImageSize& image : recipe.sizing.images) images.push_back((folder / image.name).string());
  for (const std::string& path : masks)
    if (Status loaded = load_file(path, [&](const auto& file) { return session.load_mask(file); }); !loaded)
      return loaded;
  for (const std::string& path : images)
    if (Status loaded = load_file(path, [&](const auto& file) { return session.load_size_image(file); });
        !loaded)
      return loaded;
  return std::monostate{};
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

Result<Recipe> with_options(const Recipe& recipe, const CaseOptions& options) {
  nlohmann::json json = recipe_to_json(recipe);
  put_read_options(options.read, json["source"]);
  if (!options.labels.empty()) json["labels"] = options.labels;
  if (!options.transfer.empty()) json["transfer"]["labels"] = options.transfer;
  if (merges_all(options) && options.merge.size() > 1)
    return usage_error("cli", "--merge: found all labels and " + std::to_string(options.merge.size() - 1) +
                                  " more groups, expected one or the other");
  if (!options.merge.empty()) json["merge"] = nlohmann::json::array();
  for (const std::string& text : options.merge) {
    if (text.empty()) continue;
    Result<nlohmann::json> group = to_group(text);
    if (!group) return group.error();
    json["merge"].push_back(std::move(group).value());
  }
  if (options.edge_mm && !std::isfinite(*options.edge_mm))
    return usage_error("cli", "--edge-mm: found " + std::to_string(*options.edge_mm) + ", expected a number");
  if (options.edge_mm) json["sizing"]["edge_mm"] = *options.edge_mm;
  const Result<nlohmann::json> edges = to_edges("--edge-label", options.edge_labels);
  if (!edges) return edges.error();
  std::set<double> sized;
  for (const nlohmann::json& edge : *edges) {
    if (!sized.insert(edge["label"].get<double>()).second)
      return usage_error("cli",
                         "--edge-label: found label " + edge["label"].dump() + " twice, expected once");
    nlohmann::json& sizes = json["sizing"]["labels"];
    std::erase_if(sizes.get_ref<nlohmann::json::array_t&>(),
                  [&](const auto& s) { return s["label"] == edge["label"]; });
    sizes.push_back(edge);
  }
  const Result<nlohmann::json> mask_edges = to_edges("--mask-edge", options.mask_edges);
  if (!mask_edges) return mask_edges.error();
  if (!mask_edges->empty() && options.masks.empty())
    return usage_error(
        "cli", "--mask-edge " + options.mask_edges[0] + ": found no --mask, expected one that it sizes");
  for (const std::string& path : options.masks)
    json["sizing"]["masks"].push_back({{"name", file_name(path)}, {"edges", *mask_edges}});
  for (const std::string& path : options.size_images)
    json["sizing"]["images"].push_back({{"name", file_name(path)}});
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

std::vector<NamedPath> inputs_of(const CaseOptions& options) {
  std::vector<NamedPath> inputs;
  for (const std::string& path : options.masks) inputs.push_back({"--mask", path});
  for (const std::string& path : options.size_images) inputs.push_back({"--size-image", path});
  if (is_link(options.input)) return inputs;
  inputs.push_back({"the input", options.input});
  const Result<Recipe> recipe = read_case(options.input);
  if (!is_case_file(options.input) || !recipe) return inputs;
  const std::filesystem::path folder = std::filesystem::path(options.input).parent_path();
  const auto add = [&](const std::string& name) {
    inputs.push_back({"the case " + options.input, (folder / name).string()});
  };
  if (recipe->source.file) add(recipe->source.file->name);
  for (const MaskSize& mask : recipe->sizing.masks) add(mask.name);
  for (const ImageSize& image : recipe->sizing.images) add(image.name);
  return inputs;
}

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
  for (const char* field : {"engine", "digest", "tets"})
    if (value.contains(field)) promise[field] = value[field];
  Result<Recipe> read = parse_recipe(nlohmann::json{{"expected", promise}});
  if (!read) return Error{ErrorCode::kBadInput, "verify", beside + ": " + read.error().message, {}};
  return read->expected;
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
  const bool is_volume = !path.empty() && !recipe->source.file;
  if (is_volume) recipe->source.file = FileSource{file_name(path), {}};
  Result<Recipe> changed = with_options(*recipe, options);
  if (!changed) return changed.error();
  if (!path.empty()) {
    const ReadOptions& read = changed->source.read;
    const auto load = [&](const auto& file) { return session.load_volume(file, read); };
    if (Status loaded = load_file(path, load); !loaded) return loaded;
    if (is_volume) changed->source = session.recipe().source;
  }
  if (Status loaded = load_side_files(*recipe, options, session); !loaded) return loaded;
  if (merges_all(options)) {
    Result<LabelGroup> group = group_of_all(*changed, session);
    if (!group) return group.error();
    changed->merge = {std::move(group).value()};
  }
  return session.set_recipe(*changed);
}

}  // namespace voxtet
