// What muscle fibres are to be like.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "types/result.h"

namespace voxtet {

/// How angles become directions (ventricular_fibres.h).
enum class FibreRule { kLinear, kBayer };

/// Degrees, in a wall seen from outside with the base above.
/// Alpha, the helix angle, is the fibre's from the circumferential direction towards the base: a fibre of
/// +60 rises to the right and is a right-handed helix about the ventricle, one of -60 a left-handed one.
/// Beta is the sheet's from the outward direction across the wall: at 0 it goes straight through the wall, at
/// 90 - in the wall, at right angles to the fibre - it points to the base where alpha is 0.
struct FibreAngles {
  double alpha_endo = 60, alpha_epi = -60;
  double beta_endo = -65, beta_epi = 25;
};

struct FibreParams {
  FibreRule rule = FibreRule::kLinear;
  FibreAngles wall;  ///< of both ventricles' free walls, each from its endocardium to the epicardium
  /// Of the septum, from its left to its right side, both as seen from the left ventricle. Empty: rule linear
  /// takes those of the wall; rule bayer, as published, alpha_endo and beta_endo on the left side and their
  /// negatives on the right one, which are the same angles as seen from the right ventricle.
  std::optional<FibreAngles> septum;
};

/// Angles by name: "bayer" 40, -50, -65, 25 (Bayer et al. 2012); "cemrg" 60, -60, -65, 25 (CEMRG's pipelines,
/// the default); "strocchi" 80, -60, -65, 25 (Strocchi et al., PLoS ONE 15, 2020); "kit" 60, -60, -45, 45
/// (Karlsruhe's LDRB_Fibers). Returns kUsage for another name.
Result<FibreAngles> fibre_angles(std::string_view preset);

/// Returns kUsage, naming the field, for an angle that is not finite or beyond 180 degrees.
Status check_fibre_params(const FibreParams& params);

}  // namespace voxtet
