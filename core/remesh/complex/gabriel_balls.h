// Whether a triangle can be a facet of a Delaunay triangulation.
#pragma once

#include <Eigen/Core>

#include "geometry/elements/triangle_measures.h"

namespace voxtet::remesh {

/// The balls that have the corners of a triangle on their boundary and hold no other point. Only those with
/// their centre within one radius of the smallest one's.
class GabrielBalls {
 public:
  /// Before any point is known. The triangle needs an area.
  explicit GabrielBalls(const TriangleCorners& corners);

  /// Without those that hold the point; one that is just inside of a ball does not count, as where four
  /// points lie on a circle but for rounding. Whether there are fewer now.
  bool leave_out(const Eigen::Vector3d& point);

  bool any() const { return low_ <= high_; }

 private:
  Eigen::Vector3d centre_, normal_;  ///< of the circumcircle
  double radius2_, low_, high_;      ///< of the centres along the normal
};

}  // namespace voxtet::remesh
