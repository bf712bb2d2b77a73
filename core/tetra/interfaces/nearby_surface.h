// The parts of a large surface that lie near a few points, by the labels they separate.
#pragma once

#include <Eigen/Core>
#include <map>
#include <span>
#include <vector>

#include "geometry/search/closest_point.h"
#include "types/surface_mesh.h"

namespace voxtet::tetra {

/// What a point of the boundary lies on: a surface, between one pair of labels, or the curve where surfaces
/// between these pairs meet; ascending.
using BoundaryKind = std::vector<Sides>;
/// Sorted, each pair once.
BoundaryKind ascending(BoundaryKind kind);

struct BoundaryPlace {
  Eigen::Vector3d at;
  BoundaryKind kind;
};

/// Closest points on a surface near given places. Linear in the surface, with little work for each triangle:
/// made for places that are few.
class NearbySurface {
 public:
  /// What is of a place's kind and within `reach_mm` of it is found; more may be.
  NearbySurface(const SurfaceMesh& surface, std::span<const BoundaryPlace> places, double reach_mm);

  /// The triangles of a surface, or the edges of a curve as triangles without area; null where none are near.
  const ClosestPointTree* of(const BoundaryKind& kind) const;

 private:
  std::map<BoundaryKind, ClosestPointTree> trees_;
};

}  // namespace voxtet::tetra
