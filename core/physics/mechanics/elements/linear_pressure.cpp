#include "physics/mechanics/elements/linear_pressure.h"

namespace voxtet::mechanics {

LinearPressure::LinearPressure(double volume_mm3, const Corners& kpa)
    : volume_(volume_mm3), kpa_(kpa), mean_((kpa[0] + kpa[1] + kpa[2] + kpa[3]) / 4) {}

LinearPressure LinearPressure::averaged(double volume_mm3, double bulk_kpa, const Corners& kpa) {
  LinearPressure out(volume_mm3, kpa);
  for (std::size_t a = 0; a < 4; ++a) out.at_[a] = dilation(bulk_kpa, kpa[a]);
  return out;
}

LinearPressure LinearPressure::stabilised(double volume_mm3, double bulk_kpa, double shear_kpa,
                                          const Corners& kpa) {
  LinearPressure out(volume_mm3, kpa);
  out.stabilisation_ = volume_mm3 / (20 * shear_kpa);
  out.at_mean_ = true;
  out.at_.fill(dilation(bulk_kpa, out.mean_));
  return out;
}

double LinearPressure::energy(double j) const {
  double squares = 0, dilations = 0;
  for (std::size_t a = 0; a < 4; ++a) {
    squares += (kpa_[a] - mean_) * (kpa_[a] - mean_);
    dilations += at_[a].energy_kpa / 4;
  }
  return volume_ * (mean_ * (j - 1) - dilations) - stabilisation_ / 2 * squares;
}

double LinearPressure::force(std::size_t a, double j) const {
  return volume_ / 4 * (j - at_[a].j) - stabilisation_ * (kpa_[a] - mean_);
}

double LinearPressure::tangent(std::size_t a, std::size_t b) const {
  const double own = a == b ? 1 : 0;
  return -volume_ / 4 * at_[a].per_kpa * (at_mean_ ? 0.25 : own) - stabilisation_ * (own - 0.25);
}

}  // namespace voxtet::mechanics
