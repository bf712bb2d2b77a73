#include "geometry/elements/rotation.h"

#include <Eigen/Geometry>
#include <cmath>

namespace voxtet {

Eigen::Matrix3d rotation_from_degrees(const Eigen::Vector3d& angles_deg) {
  constexpr double kRadians = 3.14159265358979323846 / 180;
  constexpr double kGrain = 1e12;
  const auto turn = [&](int axis) {
    return Eigen::AngleAxisd(angles_deg[axis] * kRadians, Eigen::Vector3d::Unit(axis)).toRotationMatrix();
  };
  const Eigen::Matrix3d exact = turn(2) * turn(1) * turn(0);
  // Adding zero turns -0 into 0, so that the bytes of the matrix agree as well.
  return exact.unaryExpr([](double x) { return std::round(x * kGrain) / kGrain + 0.0; });
}

}  // namespace voxtet
