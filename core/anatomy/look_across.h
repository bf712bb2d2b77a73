// What an image holds on the other side of a triangle.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>

#include "types/grid.h"

namespace voxtet::anatomy {

/// Looks from triangles along their normals into a grid of voxels. From seven points of the triangle a ray
/// starts half a voxel in front of it and goes on by half voxels, up to two of the widest voxels or a third
/// of the triangle's size, whichever is more. Each ray votes for what it meets first on the other side, so
/// that neither a triangle that lies a little inside its label's voxels, as smoothing and coarse edges bring
/// about, nor a single stray voxel decides.
class LookAcross {
 public:
  explicit LookAcross(const Grid& grid)
      : step_mm_(grid.smallest_spacing_mm() / 2), least_reach_mm_(2 * grid.spacing_mm().maxCoeff()) {
    static_cast<Grid&>(grid_) = grid;
    grid_.invert();
  }

  /// The value with the most votes, of equals the lowest; none if no ray meets any. `normal`: unit length.
  /// `value_at(i, j, k)`: an optional number at a voxel, which may lie outside of the grid; none means that
  /// the voxel is still on this side.
  template <class ValueAt>
  std::optional<std::uint16_t> vote(const std::array<Eigen::Vector3d, 3>& corners,
                                    const Eigen::Vector3d& normal, ValueAt&& value_at) const {
    const auto& [a, b, c] = corners;
    const double size_mm = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const double reach_mm = std::max(least_reach_mm_, size_mm / 3);
    std::map<std::uint16_t, int> votes;
    for (const Eigen::Vector3d& weights : kStarts) {
      const Eigen::Vector3d start = weights[0] * a + weights[1] * b + weights[2] * c;
      for (double way = step_mm_; way <= reach_mm; way += step_mm_) {
        const Eigen::Vector3d index = (grid_.to_index(start + way * normal).array() + 0.5).floor();
        const std::optional<std::uint16_t> met =
            value_at(static_cast<int>(index[0]), static_cast<int>(index[1]), static_cast<int>(index[2]));
        if (!met) continue;
        ++votes[*met];
        break;
      }
    }
    std::optional<std::uint16_t> best;
    for (const auto& [value, count] : votes)
      if (!best || count > votes[*best]) best = value;
    return best;
  }

 private:
  inline static const std::array<Eigen::Vector3d, 7> kStarts{
      Eigen::Vector3d(4, 4, 4) / 12, Eigen::Vector3d(8, 2, 2) / 12, Eigen::Vector3d(2, 8, 2) / 12,
      Eigen::Vector3d(2, 2, 8) / 12, Eigen::Vector3d(5, 5, 2) / 12, Eigen::Vector3d(5, 2, 5) / 12,
      Eigen::Vector3d(2, 5, 5) / 12};

  SearchableGrid grid_;
  double step_mm_, least_reach_mm_;
};

}  // namespace voxtet::anatomy
