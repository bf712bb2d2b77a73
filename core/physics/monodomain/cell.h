// The cell of Mitchell and Schaeffer: its reaction over a step, and what is known of it in closed form.
#pragma once

#include <optional>
#include <string>

#include "types/tissue.h"

namespace voxtet {

// v is the membrane's voltage, 0 at rest and at most about 1; w is the gate, 1 at rest.
//   original   dv/dt = w v^2 (1 - v) / tau_in - v / tau_out + J
//   modified   dv/dt = w v (v - gate) (1 - v) / tau_in - (1 - w) v / tau_out + J
//   both       dw/dt = (1 - w) / tau_open where v < gate, else -w / tau_close
// Mitchell and Schaeffer, Bulletin of Mathematical Biology 65 (2003); modified: Corrado and Niederer,
// Mathematical Biosciences 281 (2016).

/// What is wrong with a cell's parameters, "tau_in_ms: found ..., expected ...". A cell that could not be
/// excited (4 tau_in >= tau_out) is wrong too.
std::optional<std::string> fault_of(const CellParams& cell);

/// The reaction of one cell over a step, in substeps of at most kMostSubstep: v by forward Euler, w exactly
/// for a constant rate.
class CellStep {
 public:
  static constexpr double kMostSubstep = 0.02;  ///< ms

  CellStep(const CellParams& cell, double step_ms);

  /// One step with the current `j`, 1/ms. The arithmetic is the same on every platform.
  void react(double& v, double& w, double j) const { react_all(&v, &w, &j, 1); }

  /// The same for some cells, each by itself.
  void react_all(double* v, double* w, const double* j, int count) const;

 private:
  template <bool modified, int count>
  void react_some(double* v, double* w, const double* j) const;

  int substeps_;
  double substep_, in_, out_, gate_, stay_closed_, stay_open_;
  bool modified_;
};

/// The speed of a plane wave into tissue whose gate is `w` (1: rested), in mm/ms for a diffusivity of 1
/// mm^2/ms; it grows with the root of the diffusivity. The wave's front is that of the cubic reaction with w
/// held. 0 where no wave passes.
double plane_wave_speed(const CellParams& cell, double w = 1);

/// The diffusivity (mm^2/ms) at which a plane wave in rested tissue has this speed (mm/ms).
double diffusivity_of(double speed_mm_per_ms, const CellParams& cell);

/// How long an action potential lasts that begins with the gate at `w`, in ms, for tau_in much shorter than
/// the other times: tau_close ln(w / w_min), w_min = 4 tau_in / tau_out. Of the original model only.
double action_potential_duration(const CellParams& cell, double w = 1);

}  // namespace voxtet
