#include "geometry/elements/triangle_measures.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/search/closest_point.h"

namespace voxtet {

TriangleShape measure_triangle(const TriangleCorners& p) {
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

double longest_edge_mm(const TriangleCorners& t) {
  return std::sqrt(
      std::max({(t[0] - t[1]).squaredNorm(), (t[1] - t[2]).squaredNorm(), (t[2] - t[0]).squaredNorm()}));
}

double sharpest_cosine(const TriangleCorners& t) {
  double a = (t[1] - t[2]).squaredNorm(), b = (t[2] - t[0]).squaredNorm(), c = (t[0] - t[1]).squaredNorm();
  if (a > b) std::swap(a, b);
  if (a > c) std::swap(a, c);
  const double size = 2 * std::sqrt(b * c);
  return size > 0 ? (b + c - a) / size : 1;
}

double fold_cosine(const Eigen::Vector3d& u, const Eigen::Vector3d& w, const Eigen::Vector3d& p,
                   const Eigen::Vector3d& q) {
  const Eigen::Vector3d e = w - u, x = p - u, y = q - u;
  const double ee = e.squaredNorm(), xe = x.dot(e), ye = y.dot(e);
  const double xx = std::max(0.0, x.squaredNorm() * ee - xe * xe),
               yy = std::max(0.0, y.squaredNorm() * ee - ye * ye);
  const double size = std::sqrt(xx * yy);
  return size > 0 ? (x.dot(y) * ee - xe * ye) / size : 1;
}

double corner_distance2(const TriangleCorners& a, const TriangleCorners& b) {
  double least = (a[0] - b[0]).squaredNorm();
  for (int i = 0; i < 3; ++i) {
    least = std::min(least, (closest_on_triangle(a[i], b[0], b[1], b[2]) - a[i]).squaredNorm());
    least = std::min(least, (closest_on_triangle(b[i], a[0], a[1], a[2]) - b[i]).squaredNorm());
  }
  return least;
}

}  // namespace voxtet
