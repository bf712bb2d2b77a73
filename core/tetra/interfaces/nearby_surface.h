// The parts of a large surface that lie near a few points, by the labels they separate.
#pragma once

#include <Eigen/Core>
#include <map>
#include <span>
#include <vector>

#include "geometry/search/closest_point.h"
#include "types/surface_mesh.h"

namespace voxtet::tetra {

/// What a point of the boundary lies on: the surface between one pair of labels, or the curve where surfaces
/// between several pairs meet; ascending.
using BoundaryKind = std::vector<Sides>;
/// Sorted, each pair once.
BoundaryKind ascending(BoundaryKind kind);

struct BoundaryPlace {
  Eigen::Vector3d at;
  BoundaryKind kind;
};

/// Closest points on a surface near given places. Linear in the surface, with little work per triangle: made
/// for few places.
class NearbySurface {
 public:
  /// Finds all parts of a place's kind within `reach_mm` of it; it may find more.
  NearbySurface(const SurfaceMesh& surface, std::span<const BoundaryPlace> places, double reach_mm);

  /// The triangles of a surface, or the edges of a curve as triangles without area; null where none are near.
  const ClosestPointTree* of(const BoundaryKind& kind) const;

 private:
  std::map<BoundaryKind, ClosestPointTree> trees_;
};

}  // namespace voxtet::tetra
