// The options that say how the file of a volume is read.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "types/read_options.h"
#include "types/result.h"

namespace voxtet {

/// As they were given; what is absent stays as the recipe says.
struct ReadOptionTexts {
  std::string unit;                        ///< --unit
  std::vector<std::string> precedence;     ///< --precedence
  std::optional<std::int64_t> background;  ///< --background
  std::optional<std::int64_t> frame;       ///< --frame
  std::vector<double> threshold;           ///< --threshold, lower and upper
};

void add_read_options(CLI::App& command, ReadOptionTexts& options);

/// Puts them into the `source` of a recipe, which judges them.
void put_read_options(const ReadOptionTexts& options, nlohmann::json& source);

/// Those of a command without a recipe. Errors: kUsage.
Result<ReadOptions> read_options_of(const ReadOptionTexts& options);

}  // namespace voxtet
