// The edge of the voxel lattice on which a vertex of an extracted surface began.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <optional>

namespace voxtet {

/// Between the centres of the voxels p and q: along an axis, or a diagonal of a face or of a cell. q is p or
/// its successor along each axis.
struct LatticeEdge {
  std::array<int, 3> p, q;
  Eigen::Vector3d direction() const { return {q[0] - p[0] + 0.0, q[1] - p[1] + 0.0, q[2] - p[2] + 0.0}; }
};

/// None for a vertex that began inside a cell or a face. `start` is in index space, exact to a small fraction
/// of a voxel; such vertices are at least a sixth from the middle of every edge.
inline std::optional<LatticeEdge> lattice_edge_of(const Eigen::Vector3d& start) {
  constexpr double kOnEdge = 1e-3;
  LatticeEdge edge{};
  for (std::size_t d = 0; d < 3; ++d) {
    const double twice = 2 * start[static_cast<Eigen::Index>(d)], whole = std::round(twice);
    if (std::abs(twice - whole) > kOnEdge) return std::nullopt;
    edge.p[d] = static_cast<int>(std::floor(whole / 2));
    edge.q[d] = static_cast<int>(std::ceil(whole / 2));
  }
  return edge;
}

}  // namespace voxtet
