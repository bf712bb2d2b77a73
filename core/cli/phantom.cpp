#include "cli/phantom.h"

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "base/digest.h"
#include "cli/cli.h"
#include "cli/print.h"
#include "cli/words/option_texts.h"
#include "io/bytes/files.h"
#include "io/volume/write_volume.h"
#include "study/cohort.h"

namespace voxtet {
namespace {

using nlohmann::json;

const std::string kFields = "source.phantom.";

json value_of(const std::string& text) {
  json value = json::parse(text, nullptr, false);
  return value.is_discarded() ? json(text) : value;
}

/// "scale=0.85:1.15" or "scar=true,false". Errors: kUsage.
Result<Draw> to_draw(const std::string& text) {
  const auto pair = split_pair("--draw", text, "NAME=FROM:TO or NAME=A,B, as scale=0.85:1.15");
  if (!pair) return pair.error();
  const auto& [name, values] = *pair;
  json draw{{"among", json::array()}};
  if (const std::vector<std::string> ends = split(values, ':'); ends.size() == 2)
    draw = {{"from", value_of(ends[0])}, {"to", value_of(ends[1])}};
  else
    for (const std::string& value : split(values, ',')) draw["among"].push_back(value_of(value));
  return parse_draw(kFields + name, draw);
}

Result<Recipe> body_of(const PhantomOptions& options) {
  Result<Recipe> recipe = with_field(Recipe{}, kFields + "kind", options.kind);
  for (const std::string& text : options.set) {
    if (!recipe) return recipe;
    const std::size_t at = text.find('=');
    if (at == std::string::npos) return usage_error("cli", "--set " + text + ": expected NAME=VALUE");
    recipe = with_field(*recipe, kFields + text.substr(0, at), text.substr(at + 1));
  }
  return recipe;
}

Status write_body(const Recipe& recipe, const std::string& path) {
  const Result<LabelVolume> volume = make_phantom(*recipe.source.phantom);
  if (!volume) return volume.error();
  const Result<Bytes> bytes = write_nifti(*volume, path.ends_with(".gz"));
  if (!bytes) return bytes.error();
  if (Status written = place_files({{path, *bytes}}); !written) return written;
  std::printf("%s: %d x %d x %d voxels, digest %s\n", path.c_str(), volume->size[0], volume->size[1],
              volume->size[2], digest_of(*volume).c_str());
  return std::monostate{};
}

Status write_cohort(const Recipe& recipe, const PhantomOptions& options) {
  Cohort cohort{
      .hearts = static_cast<std::size_t>(options.hearts), .seed = options.seed.value_or(1), .draws = {}};
  for (const std::string& text : options.draw) {
    Result<Draw> draw = to_draw(text);
    if (!draw) return draw.error();
    cohort.draws.push_back(*std::move(draw));
  }
  std::error_code failed;
  std::filesystem::create_directories(options.out, failed);  // what cannot be made is found below
  for (std::size_t number = 1; number <= cohort.hearts; ++number) {
    const Result<DrawnHeart> heart = draw_heart(recipe, cohort, number);
    if (!heart) return heart.error();
    char name[32];
    std::snprintf(name, sizeof name, "heart_%04zu.nii.gz", number);
    if (Status written = write_body(heart->recipe, (std::filesystem::path(options.out) / name).string());
        !written)
      return written;
  }
  return std::monostate{};
}

}  // namespace

void add_phantom_command(CLI::App& command, PhantomOptions& options) {
  command
      .add_option("NAME", options.kind,
                  "sphere, shell, torus, slab, nested_boxes, branching_tube, biventricle, atlas")
      ->required();
  command.add_option("--set", options.set, "a field of the phantom, as spacing_mm=[1,1,1]");
  command
      .add_option("--hearts", options.hearts,
                  "a cohort of so many, which -o is a folder for, drawn by --draw")
      ->check(number_as("a whole number as 100", [](double n) { return n >= 1 && n <= 1e5 && is_whole(n); }));
  command.add_option("--seed", options.seed,
                     "of the cohort, 1 if absent; a larger one begins with the same hearts");
  command.add_option(
      "--draw", options.draw,
      "a field of the phantom that is drawn for each heart, as scale=0.85:1.15 or scar=true,false");
  command.add_option("-o,--output", options.out, ".nii or .nii.gz; of a cohort a folder")->required();
}

int run_phantom(const PhantomOptions& options) {
  const Result<Recipe> recipe = body_of(options);
  if (!recipe) return fail(recipe.error());
  if (options.hearts > 0) {
    const Status written = write_cohort(*recipe, options);
    return written ? kExitOk : fail(written.error());
  }
  if (options.seed)
    return fail(usage_error(
        "cli", "--seed " + std::to_string(*options.seed) + ": expected --hearts too, which are drawn by it"));
  if (!options.draw.empty())
    return fail(usage_error(
        "cli", "--draw " + options.draw[0] + ": expected --hearts too, of which it is drawn for each"));
  if (!is_nifti_name(options.out))
    return fail(usage_error("cli", options.out + ": a phantom is written as .nii or .nii.gz"));
  const Status written = write_body(*recipe, options.out);
  return written ? kExitOk : fail(written.error());
}

}  // namespace voxtet
