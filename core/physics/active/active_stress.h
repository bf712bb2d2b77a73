// The stress with which muscle contracts along its fibres, from when it is activated to when it has
// recovered. Bestel, Clement and Sorine, "A biomechanical model of muscle contraction", MICCAI (2001).
#pragma once

#include "types/result.h"

namespace voxtet {

/// d sigma / dt = -|a| sigma + peak max(a, 0), where a goes from -fall to rise and back by
///
///     a = rise f - fall (1 - f),   f = S(t - start) S(end - t),   S(x) = (1 + tanh(x / switch)) / 2.
///
/// With switch_ms = 0 the switches are jumps: the reduced law of Sermesant, Delingette and Ayache, "An
/// electromechanical model of the heart for image analysis and simulation", IEEE TMI 25 (2006).
struct ActiveStressLaw {
  double peak_kpa = 80;
  double rise_per_s = 25;
  double fall_per_s = 20;
  double switch_ms = 0;
};

/// Returns kUsage, naming the field, for a number that is not finite, negative, or a rate of 0.
Status check_active_stress(const ActiveStressLaw& law);

/// kPa at a time, from no stress before muscle is activated at `start_ms` and until after it has recovered at
/// `end_ms`. The exact solution in closed form, without steps in time. 0 where a time is NaN, as that of
/// tissue that no wave reaches, and where there is too little time between the switches for a > 0. The same
/// bytes on every platform. `law` has passed check_active_stress().
double active_stress_kpa(const ActiveStressLaw& law, double start_ms, double end_ms, double time_ms);

/// A law for each ventricle, and where they were published for a heart that contracts all at once, its times.
struct ActiveStressPreset {
  ActiveStressLaw lv, rv;
  double start_ms = 0, end_ms = 0;  ///< both 0: not published
};

enum class ActiveStressPresetName {
  kFast,            ///< the reduced law with 80 and 50 kPa
  kAmbit,           ///< of Ambit's demos (Hirschvogel), whose linear switches are those of the benchmark here
  kElastodynamics,  ///< the benchmark of Arostica et al., CMAME 435 (2025)
};

ActiveStressPreset active_stress_preset(ActiveStressPresetName name);

}  // namespace voxtet
