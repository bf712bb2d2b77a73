// Pressures at the corners of a linear tetrahedron, as unknowns beside the displacements.
#pragma once

#include <array>
#include <cstddef>

#include "physics/mechanics/materials/material.h"

namespace voxtet::mechanics {

/// In a tetrahedron of the undeformed volume V that is deformed by J, with corner pressures p_a of the mean
/// m, and U* that of dilation(). In balance the energy is greatest among pressures.
///
/// Average nodal pressure: V m (J - 1) - V/4 sum U*(p_a). Over all tetrahedra p_a is then U' of the volume
/// around the corner over what it was. Bonet and Burton, Communications in Numerical Methods in Engineering
/// 14 (1998). Stabilised: V (m (J - 1) - U*(m)) - 1 / (2 shear) integral of (p - m)^2, where p is linear; the
/// shear modulus is the scale of what stabilises. Dohrmann and Bochev, International Journal for Numerical
/// Methods in Fluids 46 (2004).
class LinearPressure {
 public:
  using Corners = std::array<double, 4>;  ///< kPa

  static LinearPressure averaged(double volume_mm3, double bulk_kpa, const Corners& kpa);
  static LinearPressure stabilised(double volume_mm3, double bulk_kpa, double shear_kpa, const Corners& kpa);

  double mean_kpa() const { return mean_; }
  double energy(double j) const;
  /// Its derivative by the pressure of corner a, mm^3.
  double force(std::size_t a, double j) const;
  /// And of that by the pressure of corner b.
  double tangent(std::size_t a, std::size_t b) const;

 private:
  LinearPressure(double volume_mm3, const Corners& kpa);

  double volume_;
  Corners kpa_;
  double mean_;
  /// The integral of (p - m)^2 over the shear modulus is that times the sum of (p_a - m)^2; averaged: 0.
  double stabilisation_ = 0;
  bool at_mean_ = false;  ///< whether all of at_ are those of the mean
  std::array<Dilation, 4> at_{};
};

}  // namespace voxtet::mechanics
