// Shape measures of a triangle.
#pragma once

#include <Eigen/Core>
#include <array>

namespace voxtet {

struct TriangleShape {
  double area_mm2 = 0;
  double min_angle_deg = 0, max_angle_deg = 0;
  double radius_ratio = 0;  ///< 2 r / R; 1 for the equilateral triangle
  double aspect_ratio =
      0;  ///< longest edge / (2 sqrt(3) r); 1 for the equilateral triangle, infinite when degenerate
};

TriangleShape measure_triangle(const std::array<Eigen::Vector3d, 3>& p);

}  // namespace voxtet
