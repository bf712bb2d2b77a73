// A chamber of the heart as an elastance that changes with time: p = E(t) (V - V0).
// Blanco and Feijoo, "A 3D-1D-0D computational model for the entire cardiovascular system", Mecanica
// Computacional 29 (2010).
#pragma once

#include <cmath>

#include "base/portable_trig.h"

namespace voxtet {

struct Elastance {
  double active_kpa_per_ml;   ///< added to the passive one at the height of contraction
  double passive_kpa_per_ml;  ///< at rest, > 0
  double unloaded_ml;         ///< V0, the volume without pressure
  double start_s, contraction_s, relaxation_s;
};

/// E, kPa/ml: passive, and from `start_s` of each beat on active by half a cosine up and another one down.
inline double elastance_at(const Elastance& chamber, double time_s, double period_s) {
  double t = std::fmod(time_s - chamber.start_s, period_s);
  if (t < 0) t += period_s;
  constexpr double kPi = 3.14159265358979323846;
  double angle = kPi;
  if (t < chamber.contraction_s)
    angle = kPi * (t / chamber.contraction_s - 1);
  else if (t < chamber.contraction_s + chamber.relaxation_s)
    angle = kPi * (t - chamber.contraction_s) / chamber.relaxation_s;
  return chamber.passive_kpa_per_ml + chamber.active_kpa_per_ml * (1 + cos_sin(angle)[0]) / 2;
}

}  // namespace voxtet
