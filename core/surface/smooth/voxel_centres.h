// Voxels' centres that a moving piece of surface would pass.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "geometry/elements/half_space.h"

namespace voxtet {

/// Whether the convex hull of points in index space comes nearer than a twentieth of a voxel to a voxel's
/// centre of those that `counts`. In doubt it does.
template <std::size_t N, class Counts>
bool reaches_centre(const std::array<const Eigen::Vector3d*, N>& hull, const Counts& counts) {
  constexpr double kDistance = 0.05;
  Eigen::Vector3d low = *hull[0], high = *hull[0];
  for (const Eigen::Vector3d* corner : hull) {
    low = low.cwiseMin(*corner);
    high = high.cwiseMax(*corner);
  }
  const Eigen::Vector3d first = (low.array() - kDistance).ceil();
  const Eigen::Vector3d last = (high.array() + kDistance).floor();
  Eigen::Vector3d centre;
  for (centre.z() = first.z(); centre.z() <= last.z(); ++centre.z())
    for (centre.y() = first.y(); centre.y() <= last.y(); ++centre.y())
      for (centre.x() = first.x(); centre.x() <= last.x(); ++centre.x()) {
        if (!counts(centre)) continue;
        Vectors<N> to_hull;
        for (std::size_t i = 0; i < N; ++i) to_hull.set(i, *hull[i], centre);
        if (!in_open_half_space(to_hull, kDistance)) return true;
      }
  return false;
}

}  // namespace voxtet
