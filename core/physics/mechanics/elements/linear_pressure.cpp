#include "physics/mechanics/elements/linear_pressure.h"

namespace voxtet::mechanics {

LinearPressure::LinearPressure(double volume_mm3, double bulk_kpa, double shear_kpa,
                               const std::array<double, 4>& kpa)
    : volume_(volume_mm3),
      stabilisation_(volume_mm3 / (20 * shear_kpa)),
      kpa_(kpa),
      mean_((kpa[0] + kpa[1] + kpa[2] + kpa[3]) / 4),
      at_mean_(dilation(bulk_kpa, mean_)) {}

double LinearPressure::energy(double j) const {
  double squares = 0;
  for (const double p : kpa_) squares += (p - mean_) * (p - mean_);
  return volume_ * (mean_ * (j - 1) - at_mean_.energy_kpa) - stabilisation_ / 2 * squares;
}

double LinearPressure::force(std::size_t a, double j) const {
  return volume_ / 4 * (j - at_mean_.j) - stabilisation_ * (kpa_[a] - mean_);
}

double LinearPressure::tangent(std::size_t a, std::size_t b) const {
  return -volume_ / 16 * at_mean_.per_kpa - stabilisation_ * ((a == b ? 1 : 0) - 0.25);
}

}  // namespace voxtet::mechanics
