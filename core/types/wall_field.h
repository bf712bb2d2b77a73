// How thick a wall is, and where between its two sides a point lies.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "types/grid_corners.h"
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
  std::vector<float> thickness_mm;                            ///< 0: nothing known, as away from the wall
  std::vector<float> potential;       ///< 0 at the inner surface, 1 at the outer one, a little beyond outside
  std::vector<std::uint8_t> in_wall;  ///< 1 inside the wall's surface

  Eigen::Vector3d to_index(const Eigen::Vector3d& point_mm) const {
    return mm_to_index.topLeftCorner<3, 3>() * point_mm + mm_to_index.topRightCorner<3, 1>();
  }
  /// Whether the grid point nearest to a continuous index lies in the wall.
  bool holds(const Eigen::Vector3d& index) const {
    if (!covers(index)) return false;
    std::size_t at = 0;
    for (int d = 2; d >= 0; --d)
      at = at * static_cast<std::size_t>(size[static_cast<std::size_t>(d)]) +
           static_cast<std::size_t>(index[d] + 0.5);
    return in_wall[at] != 0;
  }
  double thickness_at_index(const Eigen::Vector3d& index) const { return sample(thickness_mm, index); }
  double thickness_at(const Eigen::Vector3d& point_mm) const {
    return sample(thickness_mm, to_index(point_mm));
  }
  double potential_at(const Eigen::Vector3d& point_mm) const { return sample(potential, to_index(point_mm)); }

 private:
  bool covers(const Eigen::Vector3d& index) const {
    return (index.array() >= 0).all() && index[0] <= size[0] - 1 && index[1] <= size[1] - 1 &&
           index[2] <= size[2] - 1;
  }

  /// Trilinear between the grid points around a continuous index that have a thickness; 0 where none has
  /// and outside of the grid.
  double sample(const std::vector<float>& values, const Eigen::Vector3d& index) const {
    if (!covers(index)) return 0;
    double sum = 0, weights = 0;
    for_grid_corners(size, index, [&](std::size_t at, double weight) {
      if (thickness_mm[at] <= 0) return;
      sum += weight * values[at];
      weights += weight;
    });
    return weights > 0 ? sum / weights : 0;
  }
};

}  // namespace voxtet
