// The sizing field: target edge length in mm at every point of space.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "types/grid.h"
#include "types/grid_corners.h"

namespace voxtet {

/// Edge length h (mm) on a grid, trilinear between grid points, clamped to the grid outside of it.
struct SizingField : SearchableGrid {
  std::vector<float> h_mm;  ///< voxel_count() values, all finite and > 0

  /// Target edge length (mm) at a patient-space point (mm).
  double at(const Eigen::Vector3d& point_mm) const {
    double h = 0;
    for_grid_corners(size, to_index(point_mm),
                     [&](std::size_t at, double weight) { h += weight * h_mm[at]; });
    return h;
  }
};

}  // namespace voxtet
