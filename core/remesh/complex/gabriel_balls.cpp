#include "remesh/complex/gabriel_balls.h"

#include <Eigen/Geometry>
#include <cmath>

namespace voxtet::remesh {
namespace {

constexpr double kInside = 0.95;  ///< of the squared radius of the smallest ball

}  // namespace

GabrielBalls::GabrielBalls(const TriangleCorners& p) {
  const Eigen::Vector3d x = p[0] - p[2], y = p[1] - p[2], n = x.cross(y);
  const double n2 = n.squaredNorm();
  centre_ = p[2] + (x.squaredNorm() * y - y.squaredNorm() * x).cross(n) / (2 * n2);
  normal_ = n / std::sqrt(n2);
  radius2_ = (centre_ - p[0]).squaredNorm();
  high_ = std::sqrt(radius2_);
  low_ = -high_;
}

/// The point's power in respect of the ball with its centre at height s is its power in respect of the
/// smallest one less 2 s times its own height.
bool GabrielBalls::leave_out(const Eigen::Vector3d& point) {
  const Eigen::Vector3d offset = point - centre_;
  const double power = offset.squaredNorm() - kInside * radius2_, height = offset.dot(normal_);
  if (height == 0) {
    if (power >= 0) return false;
    high_ = low_ - 1;
    return true;
  }
  const double end = power / (2 * height);
  if (height > 0 ? end >= high_ : end <= low_) return false;
  (height > 0 ? high_ : low_) = end;
  return true;
}

}  // namespace voxtet::remesh
