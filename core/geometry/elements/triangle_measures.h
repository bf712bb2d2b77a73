// Shape measures of a triangle and of pairs of triangles.
#pragma once

#include <Eigen/Core>
#include <array>

namespace voxtet {

/// The corners of a triangle.
using TriangleCorners = std::array<Eigen::Vector3d, 3>;

struct TriangleShape {
  double area_mm2 = 0;
  double min_angle_deg = 0, max_angle_deg = 0;
  double radius_ratio = 0;  ///< 2 r / R; 1 for the equilateral triangle
  double aspect_ratio =
      0;  ///< longest edge / (2 sqrt(3) r); 1 for the equilateral triangle, infinite when degenerate
};

TriangleShape measure_triangle(const TriangleCorners& p);

/// Length of the longest edge, mm.
double longest_edge_mm(const TriangleCorners& t);

/// Cosine of the smallest angle of a triangle; 1 when two corners coincide.
double sharpest_cosine(const TriangleCorners& t);

/// Cosine of the angle at the edge u w between the half planes through p and q: 1 when folded, -1 when flat.
double fold_cosine(const Eigen::Vector3d& u, const Eigen::Vector3d& w, const Eigen::Vector3d& p,
                   const Eigen::Vector3d& q);

/// Squared distance (mm2) between the corners of one triangle and the other triangle, the least of the six.
/// Where edges cross in front of each other, the distance of the triangles may be less.
double corner_distance2(const TriangleCorners& a, const TriangleCorners& b);

}  // namespace voxtet
