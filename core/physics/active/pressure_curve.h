// Pressures in the cavities that are given as curves in time, where no circulation computes them: those of
// the elastodynamics benchmark of Arostica et al., CMAME 435 (2025).
#pragma once

#include <string_view>
#include <vector>

#include "types/result.h"

namespace voxtet {

/// dp/dt = -|b| p + mid max(b, 0) + pre g from p(0) = 0, where
///
///     b = rise f - fall (1 - f) + pre_per_s g + mid_per_s,
///     f = S(t - start) S(end - t),   g = S(end - t),   S(x) = (1 + tanh(x / switch)) / 2.
struct PressureCurve {
  double pre_kpa_per_s = 7;
  double mid_kpa = 16;
  double pre_per_s = 5;
  double mid_per_s = 1;
  double rise_per_s = 5;
  double fall_per_s = 30;
  double start_ms = 170;
  double end_ms = 484;
  double switch_ms = 5;  ///< > 0
};

/// By name: "monoventricle", "biventricle_lv", "biventricle_rv". Returns kUsage for another name.
Result<PressureCurve> pressure_curve(std::string_view name);

/// kPa at 0, `step_ms`, 2 `step_ms`, ... up to `end_ms`, by the method of Runge and Kutta of fourth order in
/// steps of at most 0.02 ms. The same bytes on every platform.
std::vector<double> pressures_kpa(const PressureCurve& curve, double end_ms, double step_ms);

}  // namespace voxtet
