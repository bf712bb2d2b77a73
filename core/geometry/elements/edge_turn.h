// The order of points around an edge, by angle.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace voxtet {

/// Angle about the edge from `from` to `to`, counted from the point `first`.
class EdgeTurn {
 public:
  EdgeTurn(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eigen::Vector3d& first)
      : from_(from), along_((to - from).normalized()), u_(spoke(first)), v_(along_.cross(u_)) {}

  /// Increases with the angle to the point, from 0 to 4 for a full turn; also 0 for a point on the edge's
  /// line. Uses only arithmetic, so that the order is the same on every platform.
  double operator()(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d to = spoke(point);
    const double x = to.dot(u_), y = to.dot(v_), size = std::abs(x) + std::abs(y);
    const double sine = size > 0 ? y / size : 0;
    return x < 0 ? 2 - sine : y < 0 ? 4 + sine : sine;
  }

 private:
  Eigen::Vector3d spoke(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d to = point - from_;
    return to - to.dot(along_) * along_;
  }

  Eigen::Vector3d from_, along_, u_, v_;
};

}  // namespace voxtet
