#include "physics/ventricles/fibre_params.h"

#include <array>
#include <cmath>
#include <sstream>
#include <utility>
#include <variant>

#include "types/stage_names.h"

namespace voxtet {
namespace {

constexpr std::array<std::pair<std::string_view, FibreAngles>, 4> kPresets{{{"bayer", {40, -50, -65, 25}},
                                                                            {"cemrg", {60, -60, -65, 25}},
                                                                            {"strocchi", {80, -60, -65, 25}},
                                                                            {"kit", {60, -60, -45, 45}}}};

std::optional<Error> check(const std::string& group, const FibreAngles& angles) {
  const std::array<std::pair<const char*, double>, 4> named{{{"alpha_endo", angles.alpha_endo},
                                                             {"alpha_epi", angles.alpha_epi},
                                                             {"beta_endo", angles.beta_endo},
                                                             {"beta_epi", angles.beta_epi}}};
  for (const auto& [name, angle] : named) {
    if (std::abs(angle) <= 180) continue;
    std::ostringstream message;
    message << "physics.fibres." << group << "." << name << ": found " << angle
            << ", expected from -180 to 180 degrees";
    return usage_error(kFibresStage, message.str());
  }
  return std::nullopt;
}

}  // namespace

Result<FibreAngles> fibre_angles(std::string_view preset) {
  std::string names;
  for (const auto& [name, angles] : kPresets) {
    if (name == preset) return angles;
    names += (names.empty() ? "" : ", ") + std::string(name);
  }
  return usage_error(
      kFibresStage, "physics.fibres.preset: found \"" + std::string(preset) + "\", expected one of " + names);
}

Status check_fibre_params(const FibreParams& params) {
  if (auto error = check("wall", params.wall)) return *std::move(error);
  if (params.septum)
    if (auto error = check("septum", *params.septum)) return *std::move(error);
  return std::monostate{};
}

}  // namespace voxtet
