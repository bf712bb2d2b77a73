// The sizing field: target edge length in mm at every point of space.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <cstddef>
#include <vector>

#include "types/grid_corners.h"

namespace voxtet {

/// Edge length h (mm) on a regular grid, trilinear between grid points, clamped to the grid outside of it.
/// `index_to_mm` maps grid indices to patient space (RAS, mm).
struct SizingField {
  std::array<int, 3> size{0, 0, 0};
  Eigen::Matrix4d index_to_mm = Eigen::Matrix4d::Identity();
  Eigen::Matrix4d mm_to_index = Eigen::Matrix4d::Identity();  ///< inverse of index_to_mm
  std::vector<float> h_mm;                                    ///< index x fastest; all finite and > 0

  /// Target edge length (mm) at a patient-space point (mm).
  double at(const Eigen::Vector3d& point_mm) const {
    const Eigen::Vector3d index =
        mm_to_index.topLeftCorner<3, 3>() * point_mm + mm_to_index.topRightCorner<3, 1>();
    double h = 0;
    for_grid_corners(size, index, [&](std::size_t at, double weight) { h += weight * h_mm[at]; });
    return h;
  }
};

}  // namespace voxtet
