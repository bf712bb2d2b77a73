// How thick a wall is, and where between its two sides a point lies.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "types/label_volume.h"

namespace voxtet {

/// Thickness and potential of the wall that some labels form, on a regular grid of its own around the wall.
/// Index x runs fastest. Values are those of points in the wall; they go on for two voxels beyond it, so that
/// sampling between grid points is sound up to the wall's surface.
struct WallField {
  std::vector<Label> wall;  ///< the labels that form the wall
  std::array<int, 3> size{0, 0, 0};
  Eigen::Matrix4d index_to_mm = Eigen::Matrix4d::Identity();
  Eigen::Matrix4d mm_to_index = Eigen::Matrix4d::Identity();  ///< inverse of index_to_mm
  std::vector<float> thickness_mm;                            ///< 0: further than two voxels from the wall
  std::vector<float> potential;       ///< 0 at the inner surface, 1 at the outer one, a little beyond outside
  std::vector<std::uint8_t> in_wall;  ///< 1 inside the wall's surface

  Eigen::Vector3d to_index(const Eigen::Vector3d& point_mm) const {
    return mm_to_index.topLeftCorner<3, 3>() * point_mm + mm_to_index.topRightCorner<3, 1>();
  }
  /// Whether the grid point nearest to a continuous index lies in the wall.
  bool holds(const Eigen::Vector3d& index) const {
    std::size_t at = 0;
    for (int d = 2; d >= 0; --d) {
      const int n = size[static_cast<std::size_t>(d)];
      if (!(index[d] >= 0 && index[d] <= n - 1)) return false;
      at = at * static_cast<std::size_t>(n) + static_cast<std::size_t>(index[d] + 0.5);
    }
    return in_wall[at] != 0;
  }
  double thickness_at_index(const Eigen::Vector3d& index) const { return sample(thickness_mm, index); }
  double thickness_at(const Eigen::Vector3d& point_mm) const {
    return sample(thickness_mm, to_index(point_mm));
  }
  double potential_at(const Eigen::Vector3d& point_mm) const { return sample(potential, to_index(point_mm)); }

 private:
  /// Trilinear between the grid points around a continuous index that have a thickness; 0 where none has.
  double sample(const std::vector<float>& values, const Eigen::Vector3d& index) const {
    std::array<int, 3> base{};
    std::array<double, 3> t{};
    for (int d = 0; d < 3; ++d) {
      const double x = std::clamp(index[d], 0.0, static_cast<double>(size[d] - 1));
      base[d] = std::min(static_cast<int>(x), std::max(0, size[d] - 2));
      t[d] = x - base[d];
    }
    double sum = 0, weights = 0;
    for (int corner = 0; corner < 8; ++corner) {
      double weight = 1;
      std::array<std::size_t, 3> c{};
      for (int d = 0; d < 3; ++d) {
        const bool up = (corner >> d) & 1;
        weight *= up ? t[d] : 1 - t[d];
        c[d] = static_cast<std::size_t>(std::min(base[d] + (up ? 1 : 0), size[d] - 1));
      }
      const std::size_t at =
          c[0] + static_cast<std::size_t>(size[0]) * (c[1] + static_cast<std::size_t>(size[1]) * c[2]);
      if (thickness_mm[at] <= 0) continue;
      sum += weight * values[at];
      weights += weight;
    }
    return weights > 0 ? sum / weights : 0;
  }
};

}  // namespace voxtet
