// Potentials and fibres of the bodies of support/ellipsoid.h.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "physics/ventricles/ventricular_fibres.h"
#include "support/ellipsoid.h"

namespace voxtet::test {

inline constexpr double kRadians = EIGEN_PI / 180;

inline VentricularPotentials potentials_of(const HeartBody& body) {
  auto potentials = ventricular_potentials(body.mesh, body.surfaces, {});
  EXPECT_TRUE(potentials.ok()) << (potentials.ok() ? "" : potentials.error().message);
  return *std::move(potentials);
}

inline Fibres fibres_of(const HeartBody& body, const FibreParams& params) {
  auto fibres = tet_fibres(body.mesh, body.surfaces, potentials_of(body), params, {});
  EXPECT_TRUE(fibres.ok()) << (fibres.ok() ? "" : fibres.error().message);
  return *std::move(fibres);
}

/// Degrees, of directions whose signs mean nothing.
inline double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b))) / kRadians;
}

}  // namespace voxtet::test
