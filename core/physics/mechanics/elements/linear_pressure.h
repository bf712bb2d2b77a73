// The pressure of a stabilised P1-P1 tetrahedron: Dohrmann and Bochev, International Journal for Numerical
// Methods in Fluids 46 (2004).
#pragma once

#include <array>
#include <cstddef>

#include "physics/mechanics/materials/material.h"

namespace voxtet::mechanics {

/// Linear, p, with the mean m. Its energy in a tetrahedron of the undeformed volume V that is deformed by J
/// is
///
///     V (m (J - 1) - U*(m)) - 1 / (2 shear) integral of (p - m)^2
///
/// where U* is that of dilation(). The shear modulus is the scale of what stabilises.
class LinearPressure {
 public:
  LinearPressure(double volume_mm3, double bulk_kpa, double shear_kpa, const std::array<double, 4>& kpa);

  double mean_kpa() const { return mean_; }
  double energy(double j) const;
  /// Its derivative by the pressure of corner a, mm^3.
  double force(std::size_t a, double j) const;
  /// And of that by the pressure of corner b.
  double tangent(std::size_t a, std::size_t b) const;

 private:
  double volume_,
      stabilisation_;  ///< stabilisation_: the integral over the shear is that times sum (p_a - m)^2
  std::array<double, 4> kpa_;
  double mean_;
  Dilation at_mean_;
};

}  // namespace voxtet::mechanics
