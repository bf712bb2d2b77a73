#include "physics/monodomain/cell.h"

#include <cmath>
#include <sstream>

namespace voxtet {
namespace {

/// exp(-x) for x in [0, 0.1], by its Pade approximant of order [3/3], to the last bits: the same on every
/// platform, which std::exp is not.
double exp_minus(double x) {
  const double even = 120 + 12 * x * x, odd = x * (60 + x * x);
  return (even - odd) / (even + odd);
}

std::string fault(const char* field, double found, const std::string& expected) {
  std::ostringstream text;
  text << field << ": found " << found << ", expected " << expected;
  return text.str();
}

}  // namespace

std::optional<std::string> fault_of(const CellParams& cell) {
  const std::pair<const char*, double> times[] = {{"tau_in_ms", cell.tau_in_ms},
                                                  {"tau_out_ms", cell.tau_out_ms},
                                                  {"tau_open_ms", cell.tau_open_ms},
                                                  {"tau_close_ms", cell.tau_close_ms}};
  for (const auto& [name, time] : times)
    if (!(std::isfinite(time) && time >= 0.2)) return fault(name, time, "at least 0.2 ms");
  if (!(cell.gate > 0 && cell.gate < 0.5)) return fault("gate", cell.gate, "a number between 0 and 0.5");
  if (!cell.modified && !(4 * cell.tau_in_ms < cell.tau_out_ms))
    return fault("tau_in_ms", cell.tau_in_ms,
                 "less than a quarter of tau_out_ms: else nothing excites the cell");
  return std::nullopt;
}

CellStep::CellStep(const CellParams& cell, double step_ms)
    : substeps_(static_cast<int>(std::ceil(step_ms / kMostSubstep * (1 - 1e-9)))),
      substep_(step_ms / substeps_),
      in_(1 / cell.tau_in_ms),
      out_(1 / cell.tau_out_ms),
      gate_(cell.gate),
      stay_closed_(exp_minus(substep_ / cell.tau_open_ms)),
      stay_open_(exp_minus(substep_ / cell.tau_close_ms)),
      modified_(cell.modified) {}

/// Written so that a compiler makes SIMD of it: both cases of the gate are computed, then one is taken.
template <bool modified, int count>
void CellStep::react_some(double* v, double* w, const double* j) const {
  double x[count], y[count];
  for (int k = 0; k < count; ++k) x[k] = v[k], y[k] = w[k];
  for (int i = 0; i < substeps_; ++i)
    for (int k = 0; k < count; ++k) {
      const double dv = modified ? y[k] * in_ * x[k] * (x[k] - gate_) * (1 - x[k]) - (1 - y[k]) * out_ * x[k]
                                 : y[k] * in_ * x[k] * x[k] * (1 - x[k]) - out_ * x[k];
      const double opening = 1 - (1 - y[k]) * stay_closed_, closing = y[k] * stay_open_;
      y[k] = x[k] < gate_ ? opening : closing;
      x[k] += substep_ * (dv + j[k]);
    }
  for (int k = 0; k < count; ++k) v[k] = x[k], w[k] = y[k];
}

void CellStep::react_all(double* v, double* w, const double* j, int count) const {
  constexpr int kAtOnce = 4;
  int k = 0;
  for (; k + kAtOnce <= count; k += kAtOnce)
    modified_ ? react_some<true, kAtOnce>(v + k, w + k, j + k)
              : react_some<false, kAtOnce>(v + k, w + k, j + k);
  for (; k < count; ++k)
    modified_ ? react_some<true, 1>(v + k, w + k, j + k) : react_some<false, 1>(v + k, w + k, j + k);
}

double plane_wave_speed(const CellParams& cell, double w) {
  // A cubic reaction k v (v - a) (b - v) has the front of speed sqrt(D k / 2) (b - 2 a).
  const double k = w / cell.tau_in_ms;
  double a = cell.gate, b = 1;
  if (cell.modified) {
    // w v (v - gate) (1 - v) - q v, with q = (1 - w) tau_in / tau_out: roots of (v - gate) (1 - v) = q / w.
    const double q = (1 - w) / cell.tau_out_ms / k;
    const double root = (1 - cell.gate) * (1 - cell.gate) - 4 * q;
    if (!(root > 0)) return 0;
    a = (1 + cell.gate - std::sqrt(root)) / 2;
    b = (1 + cell.gate + std::sqrt(root)) / 2;
  } else {
    const double root = 1 - 4 / (cell.tau_out_ms * k);
    if (!(root > 0)) return 0;
    a = (1 - std::sqrt(root)) / 2;
    b = (1 + std::sqrt(root)) / 2;
  }
  return std::max(0.0, std::sqrt(k / 2) * (b - 2 * a));
}

double diffusivity_of(double speed_mm_per_ms, const CellParams& cell) {
  const double ratio = speed_mm_per_ms / plane_wave_speed(cell);
  return ratio * ratio;
}

double action_potential_duration(const CellParams& cell, double w) {
  return cell.tau_close_ms * std::log(w * cell.tau_out_ms / (4 * cell.tau_in_ms));
}

}  // namespace voxtet
