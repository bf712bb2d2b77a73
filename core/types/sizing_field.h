// The wish for element size: edge length in mm at every point of space.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace voxtet {

/// Edge length h (mm) on a regular grid, trilinear between grid points, clamped to the grid outside of it.
/// `index_to_mm` maps grid indices to patient space (RAS, mm).
struct SizingField {
  std::array<int, 3> size{0, 0, 0};
  Eigen::Matrix4d index_to_mm = Eigen::Matrix4d::Identity();
  Eigen::Matrix4d mm_to_index = Eigen::Matrix4d::Identity();  ///< inverse of index_to_mm
  std::vector<float> h_mm;                                    ///< index x fastest; all finite and > 0

  /// Wished edge length (mm) at a patient-space point (mm).
  double at(const Eigen::Vector3d& point_mm) const {
    const Eigen::Vector3d index =
        mm_to_index.topLeftCorner<3, 3>() * point_mm + mm_to_index.topRightCorner<3, 1>();
    std::array<int, 3> base{};
    std::array<double, 3> t{};
    for (int d = 0; d < 3; ++d) {
      const double x = std::clamp(index[d], 0.0, static_cast<double>(size[d] - 1));
      base[d] = std::min(static_cast<int>(x), std::max(0, size[d] - 2));
      t[d] = x - base[d];
    }
    double h = 0;
    for (int corner = 0; corner < 8; ++corner) {
      double weight = 1;
      std::array<int, 3> c{};
      for (int d = 0; d < 3; ++d) {
        const bool up = (corner >> d) & 1;
        weight *= up ? t[d] : 1 - t[d];
        c[d] = std::min(base[d] + (up ? 1 : 0), size[d] - 1);
      }
      h += weight * h_mm[static_cast<std::size_t>(c[0]) +
                         static_cast<std::size_t>(size[0]) *
                             (static_cast<std::size_t>(c[1]) +
                              static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(c[2]))];
    }
    return h;
  }
};

}  // namespace voxtet
