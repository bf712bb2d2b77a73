// Whether a triangle can be a facet of a Delaunay triangulation.
#pragma once

#include <Eigen/Core>

#include "geometry/elements/triangle_measures.h"

namespace voxtet::remesh {

/// The balls that have the corners of a triangle on their boundary and contain no other point. Only balls
/// whose centre is within one radius of that of the smallest one are considered.
class GabrielBalls {
 public:
  /// All balls, as if there were no other points. The triangle must have an area.
  explicit GabrielBalls(const TriangleCorners& corners);

  /// Removes the balls that contain the point. A point only just inside of a ball does not count, as when
  /// four points lie on a circle except for rounding. Returns whether balls were removed.
  bool leave_out(const Eigen::Vector3d& point);

  bool any() const { return low_ <= high_; }

 private:
  Eigen::Vector3d centre_, normal_;  ///< of the circumcircle
  double radius2_, low_, high_;      ///< range of the centres along the normal
};

}  // namespace voxtet::remesh
