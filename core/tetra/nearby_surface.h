// The parts of a large surface that lie near a few points, by the labels they separate.
#pragma once

#include <Eigen/Core>
#include <map>
#include <span>
#include <vector>

#include "geometry/closest_point.h"
#include "types/surface_mesh.h"

namespace voxtet::tetra {

/// A point on the boundary between two labels.
struct BoundaryPlace {
  Eigen::Vector3d at;
  Sides sides;
};

/// Closest points on a surface near given places. Linear in the surface, with little work for each triangle:
/// made for places that are few.
class NearbySurface {
 public:
  /// Triangles within `reach_mm` of a place with the same sides are found; others may be.
  NearbySurface(const SurfaceMesh& surface, std::span<const BoundaryPlace> places, double reach_mm);

  /// The triangles between two labels; null where none are near.
  const ClosestPointTree* between(const Sides& sides) const;

 private:
  std::map<Sides, ClosestPointTree> trees_;
};

}  // namespace voxtet::tetra
