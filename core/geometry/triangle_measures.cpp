#include "geometry/triangle_measures.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace voxtet {

TriangleShape measure_triangle(const std::array<Eigen::Vector3d, 3>& p) {
  constexpr double degrees = 57.295779513082320877;
  TriangleShape shape;
  const double twice_area = (p[1] - p[0]).cross(p[2] - p[0]).norm();
  shape.area_mm2 = 0.5 * twice_area;
  std::array<double, 3> length{};
  shape.min_angle_deg = 180;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d u = p[(i + 1) % 3] - p[i], v = p[(i + 2) % 3] - p[i];
    length[i] = u.norm();
    const double angle = std::atan2(twice_area, u.dot(v)) * degrees;
    shape.min_angle_deg = std::min(shape.min_angle_deg, angle);
    shape.max_angle_deg = std::max(shape.max_angle_deg, angle);
  }
  const double perimeter = length[0] + length[1] + length[2];
  const double longest = *std::max_element(length.begin(), length.end());
  if (twice_area <= 0) {
    shape.aspect_ratio = std::numeric_limits<double>::infinity();
    return shape;
  }
  const double inradius = twice_area / perimeter;
  const double circumradius = length[0] * length[1] * length[2] / (2 * twice_area);
  shape.radius_ratio = 2 * inradius / circumradius;
  shape.aspect_ratio = longest / (2 * std::sqrt(3.0) * inradius);
  return shape;
}

}  // namespace voxtet
