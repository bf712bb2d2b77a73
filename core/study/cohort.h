// Hearts drawn at random, the same on every machine.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "recipe/recipe.h"
#include "types/result.h"

namespace voxtet {

/// From what a field of a recipe is drawn: a range, or a list of values.
struct Draw {
  std::string field;  ///< path in the recipe, as "source.phantom.scale"
  double from = 0, to = 0;
  nlohmann::json among;  ///< an array; null: a range
};

/// {"from": 0.85, "to": 1.15} or {"among": [true, false]}. Errors: kUsage naming the field.
Result<Draw> parse_draw(const std::string& field, const nlohmann::json& json);

/// The value of a field for the heart of a number, counted from 1. It depends on these, the seed and what it
/// is drawn from alone: a larger cohort begins with the same hearts. A range is cut into a thousand equal
/// steps, each of which is as likely; the value has six significant digits.
nlohmann::json drawn_value(const Draw& draw, std::uint64_t seed, std::size_t heart);

/// Generated hearts, each with fields of its own.
struct Cohort {
  std::size_t hearts = 0;
  std::uint64_t seed = 1;
  std::vector<Draw> draws;
};

/// Fields of a recipe and their values.
using FieldValues = std::vector<std::pair<std::string, nlohmann::json>>;

struct DrawnHeart {
  Recipe recipe;
  FieldValues drawn;
};

/// The heart of a number, counted from 1: a recipe with the fields that are drawn. Its phantom is seeded by
/// that number, unless the seed is drawn. Errors: kUsage naming the heart and the field that is none or out
/// of range.
Result<DrawnHeart> draw_heart(const Recipe& recipe, const Cohort& cohort, std::size_t heart);

}  // namespace voxtet
