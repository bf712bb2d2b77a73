#include "cli/words/read_options.h"

#include <nlohmann/json.hpp>

#include "cli/words/option_texts.h"
#include "recipe/recipe.h"

namespace voxtet {

void add_read_options(CLI::App& command, ReadOptionTexts& options) {
  command.add_option("--unit", options.unit,
                     "unit of the volume's lengths, whatever it says: m, cm, mm, um, nm");
  command
      .add_option("--precedence", options.precedence,
                  "segments by name or label: the first wins where segments overlap, as inner,outer")
      ->delimiter(',');
  command.add_option("--background", options.background, "the volume's value of the background, as -1")
      ->check(number_as("a whole number as -1", is_whole));
  command.add_option("--frame", options.frame, "frame of a volume with several, counted from 0")
      ->check(number_as("a whole number as 0", is_whole));
  command
      .add_option("--threshold", options.threshold,
                  "of an image without labels: the values that become label 1, as 200,1000")
      ->delimiter(',')
      ->expected(2);
}

void put_read_options(const ReadOptionTexts& options, nlohmann::json& source) {
  if (!options.unit.empty()) source["unit"] = options.unit;
  if (!options.precedence.empty()) source["precedence"] = options.precedence;
  if (options.background) source["background"] = *options.background;
  if (options.frame) source["frame"] = *options.frame;
  if (!options.threshold.empty())
    source["threshold"] = {{"lower", options.threshold.front()}, {"upper", options.threshold.back()}};
}

Result<ReadOptions> read_options_of(const ReadOptionTexts& options) {
  nlohmann::json recipe{{"source", nlohmann::json::object()}};
  put_read_options(options, recipe["source"]);
  const Result<Recipe> parsed = parse_recipe(recipe);
  if (!parsed) return parsed.error();
  return parsed->source.read;
}

}  // namespace voxtet
