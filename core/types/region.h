// A place in space: sphere, box or capsule.
#pragma once

#include <Eigen/Core>

namespace voxtet {

enum class RegionShape { kSphere, kBox, kCapsule };

/// sphere: centre_mm, radius_mm. box: centre_mm, half_size_mm along the RAS axes, rotated by `axes_deg`
/// (extrinsic x, then y, then z). capsule: segment centre_mm..end_mm with radius_mm.
struct Region {
  RegionShape shape = RegionShape::kSphere;
  Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d end_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d half_size_mm = Eigen::Vector3d::Constant(10);
  Eigen::Vector3d axes_deg = Eigen::Vector3d::Zero();
  double radius_mm = 10;
};

}  // namespace voxtet
