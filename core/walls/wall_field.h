// How thick a wall is, and where between its two sides a point lies.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "types/grid.h"
#include "types/grid_corners.h"
#include "types/label_volume.h"

namespace voxtet {

/// Thickness and potential of the wall that some labels form, on a grid of its own around the wall. Values
/// are those of points in the wall. They are continued for two voxels beyond it, so that interpolation
/// between grid points is right up to the wall's surface.
struct WallField : SearchableGrid {
  std::vector<Label> wall;            ///< the labels that form the wall
  std::vector<float> thickness_mm;    ///< 0: unknown, as away from the wall
  std::vector<float> potential;       ///< 0 at the inner surface, 1 at the outer one, a little beyond outside
  std::vector<std::uint8_t> in_wall;  ///< 1 inside the wall's surface
  /// For each inner space, the harmonic measure of its surface: 1 there and 0 on all other surfaces. The
  /// outer surface has what is missing to 1. Empty if not asked for.
  std::vector<std::vector<float>> inner_shares;

  /// Whether the grid point nearest to a continuous index lies in the wall.
  bool holds(const Eigen::Vector3d& index) const {
    if (!covers(index)) return false;
    const Eigen::Vector3i nearest = (index.array() + 0.5).cast<int>();
    return in_wall[offset(nearest)] != 0;
  }
  double thickness_at_index(const Eigen::Vector3d& index) const { return sample(thickness_mm, index); }
  double thickness_at(const Eigen::Vector3d& point_mm) const {
    return sample(thickness_mm, to_index(point_mm));
  }
  double potential_at(const Eigen::Vector3d& point_mm) const { return sample(potential, to_index(point_mm)); }
  /// The shares of the outer surface and of each inner one, in this order; empty where nothing is known.
  using Shares = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 256, 1>;
  Shares shares_at(const Eigen::Vector3d& point_mm) const {
    const Eigen::Vector3d index = to_index(point_mm);
    if (!covers(index)) return Shares();
    Shares shares = Shares::Zero(static_cast<Eigen::Index>(1 + inner_shares.size()));
    double weights = 0;
    for_grid_corners(size, index, [&](std::size_t at, double weight) {
      if (thickness_mm[at] <= 0) return;
      weights += weight;
      for (std::size_t s = 0; s < inner_shares.size(); ++s)
        shares[static_cast<Eigen::Index>(1 + s)] += weight * inner_shares[s][at];
    });
    if (!(weights > 0)) return Shares();
    shares /= weights;
    shares[0] = 1 - shares.sum();
    return shares;
  }

 private:
  bool covers(const Eigen::Vector3d& index) const {
    return (index.array() >= 0).all() && index[0] <= size[0] - 1 && index[1] <= size[1] - 1 &&
           index[2] <= size[2] - 1;
  }

  /// Trilinear interpolation between those grid points around a continuous index that have a thickness; 0 if
  /// none has, and outside of the grid.
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

/// A wall with the number of layers that is asked for.
struct LayeredWall {
  const WallField& field;
  std::uint32_t layers = 1;
  bool exact = false;  ///< whether they shall be exact
};

}  // namespace voxtet
