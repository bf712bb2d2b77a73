#include "surface/smooth/crossing_limits.h"

#include <Eigen/Geometry>
#include <cmath>
#include <optional>

#include "geometry/elements/surface_measures.h"
#include "surface/smooth/lattice_edge.h"

namespace voxtet {
namespace {

constexpr double kHalf = 0.5;       ///< of an edge, from its middle to an end
constexpr double kCrossing = 0.45;  ///< so that a voxel's centre is passed nowhere along it

}  // namespace

std::vector<CrossingLimit> crossing_limits(const std::vector<Triangle>& triangles,
                                           const std::vector<Eigen::Vector3d>& start,
                                           const std::vector<Eigen::Vector3d>& points,
                                           const Eigen::Vector3d& reach) {
  const Eigen::Vector3d further = (reach.array() - kHalf).max(0);
  std::vector<CrossingLimit> limits(start.size());
  for (const auto& [a, b, c] : triangles) {
    const Eigen::Vector3d cross = triangle_cross(points[a], points[b], points[c]);
    for (const std::uint32_t v : {a, b, c}) limits[v].normal += cross;
  }
  for (std::size_t v = 0; v < limits.size(); ++v) {
    const std::optional<LatticeEdge> edge = lattice_edge_of(start[v]);
    Eigen::Vector3d& normal = limits[v].normal;
    normal = edge ? normal.normalized() : Eigen::Vector3d(Eigen::Vector3d::Zero());
    if (edge)
      limits[v].reach = kCrossing * std::abs(normal.dot(edge->direction())) + normal.cwiseAbs().dot(further);
  }
  return limits;
}

}  // namespace voxtet
