#include "study/cohort.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "base/digest.h"

namespace voxtet {
namespace {

using nlohmann::json;

/// Uniform in [0, 1): the first 52 bits of a digest.
double uniform(const std::string& field, std::uint64_t seed, std::size_t heart) {
  Sha256 sha;
  sha.update(std::to_string(seed) + "/" + std::to_string(heart) + "/" + field);
  const std::uint64_t bits = std::strtoull(sha.hex().substr(0, 13).c_str(), nullptr, 16);
  return static_cast<double>(bits) / 0x1p52;
}

}  // namespace

Result<Draw> parse_draw(const std::string& field, const json& value) {
  const auto number = [&](const char* name) { return value.contains(name) && value[name].is_number(); };
  Draw draw{.field = field};
  if (value.is_object() && value.size() == 2 && number("from") && number("to")) {
    draw.from = value["from"];
    draw.to = value["to"];
    if (draw.from <= draw.to) return draw;
  } else if (value.is_object() && value.size() == 1 && value.contains("among") && value["among"].is_array() &&
             !value["among"].empty()) {
    draw.among = value["among"];
    return draw;
  }
  return usage_error("study",
                     "the draw of " + field + ": found " + value.dump() +
                         R"(, expected {"from": 0.8, "to": 1.2}, the lesser first, or {"among": [1, 2]})");
}

json drawn_value(const Draw& draw, std::uint64_t seed, std::size_t heart) {
  const double u = uniform(draw.field, seed, heart);
  if (draw.among.is_array())
    return draw.among[static_cast<std::size_t>(u * static_cast<double>(draw.among.size()))];
  constexpr double kSteps = 1000;
  const double step = static_cast<double>(static_cast<int>(u * (kSteps + 1)));
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", draw.from + (draw.to - draw.from) * step / kSteps);
  return std::strtod(text, nullptr);
}

Result<DrawnHeart> draw_heart(const Recipe& recipe, const Cohort& cohort, std::size_t heart) {
  DrawnHeart out{recipe, {}};
  for (const Draw& draw : cohort.draws) {
    json value = drawn_value(draw, cohort.seed, heart);
    Result<Recipe> changed = with_field(out.recipe, draw.field, value.dump());
    if (!changed)
      return usage_error("study", "cohort, heart " + std::to_string(heart) + ": " + changed.error().message);
    out.recipe = *std::move(changed);
    out.drawn.emplace_back(draw.field, std::move(value));
  }
  const auto seeds = [](const Draw& draw) { return draw.field == "source.phantom.seed"; };
  if (out.recipe.source.phantom && std::none_of(cohort.draws.begin(), cohort.draws.end(), seeds))
    out.recipe.source.phantom->seed = static_cast<std::uint32_t>(heart);
  return out;
}

}  // namespace voxtet
