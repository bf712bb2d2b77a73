// A heart valve: a small resistance one way and a large one the other, with a smooth change between them, so
// that Newton's method does not cycle as it does with a jump.
#pragma once

#include <cmath>

namespace voxtet {

struct Valve {
  double open_kpa_s_per_ml = 1e-3;
  double closed_kpa_s_per_ml = 1e4;
  /// Over how much pressure it changes. Without a pressure difference half of it drives what flows.
  double width_kpa = 1.3e-3;
};

/// The same valve, which lets blood back with `share` of the conductance that it has when open: 0.02 to 0.1
/// for pulmonary regurgitation after repair of Tetralogy of Fallot.
inline Valve regurgitant(Valve valve, double share) {
  valve.closed_kpa_s_per_ml = valve.open_kpa_s_per_ml / share;
  return valve;
}

struct ValveFlow {
  double ml_per_s;
  double slope;  ///< its derivative with respect to the pressure difference, ml/s/kPa; > 0
};

/// The flow at a difference of pressure, upstream less downstream:
///
///     q = x / closed + (1 / open - 1 / closed) m(x),   m(x) = (x + sqrt(x^2 + width^2)) / 2,
///
/// where m is the smooth maximum of x and 0 of Chen, Harker, Kanzow and Smale; q rises monotonely, and is
/// convex.
inline ValveFlow flow_through(const Valve& valve, double x) {
  const double closed = 1 / valve.closed_kpa_s_per_ml, more = 1 / valve.open_kpa_s_per_ml - closed;
  const double root = std::sqrt(x * x + valve.width_kpa * valve.width_kpa);
  return {closed * x + more * (x + root) / 2, closed + more * (1 + x / root) / 2};
}

}  // namespace voxtet
