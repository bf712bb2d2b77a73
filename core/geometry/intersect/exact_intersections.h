// A second, independent check for self-intersections: exact, by CGAL's predicates. Slow; for checks of what
// should hold by construction.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "types/surface_mesh.h"

namespace voxtet {

class ExactTriangles {
 public:
  explicit ExactTriangles(const SurfaceMesh& surface) : triangles_(surface.triangles) {
    points_.reserve(surface.points.size());
    for (const Eigen::Vector3d& p : surface.points) points_.emplace_back(p.x(), p.y(), p.z());
  }

  bool flat(std::uint32_t t) const {
    const auto [a, b, c] = triangles_[t];
    return CGAL::collinear(points_[a], points_[b], points_[c]);
  }
  /// Whether two triangles with an area have more in common than their common corners or edge.
  bool meet(std::uint32_t t, std::uint32_t s) const {
    // Common corners come first, in the same order.
    Triangle a = triangles_[t], b = triangles_[s];
    std::size_t common = 0;
    for (std::size_t i = 0; i < 3; ++i)
      if (const auto found = std::find(b.begin(), b.end(), a[i]); found != b.end()) {
        std::iter_swap(found, b.begin() + static_cast<std::ptrdiff_t>(common));
        std::swap(a[i], a[common++]);
      }
    switch (common) {
      case 0: return CGAL::do_intersect(solid(t), solid(s));
      case 1: return sectors_meet(a, b);
      case 2: return folded(a, b[2]);
      default: return true;
    }
  }
  CGAL::Bbox_3 box(std::uint32_t t) const { return solid(t).bbox(); }

 private:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

  Kernel::Triangle_3 solid(std::uint32_t t) const {
    const auto [a, b, c] = triangles_[t];
    return {points_[a], points_[b], points_[c]};
  }
  int side(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
    return CGAL::orientation(points_[a], points_[b], points_[c], points_[d]);
  }
  int flat_side(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
    return CGAL::coplanar_orientation(points_[a], points_[b], points_[c], points_[d]);
  }
  bool folded(const Triangle& a, std::uint32_t other) const {
    return side(a[0], a[1], a[2], other) == 0 && flat_side(a[0], a[1], a[2], other) > 0;
  }
  /// Two triangles with the common corner v meet elsewhere exactly if the sectors that they span at v do. For
  /// vectors from v, r2 a1 - r1 a2 = s1 b2 - s2 b1 (Cramer; the coefficients are the determinants below) is
  /// the only combination of the a's that is one of the b's. The sectors share a ray if all four coefficients
  /// can be made nonnegative.
  bool sectors_meet(const Triangle& a, const Triangle& b) const {
    const int s1 = side(a[0], a[1], a[2], b[1]), s2 = side(a[0], a[1], a[2], b[2]);
    if (s1 * s2 > 0) return false;
    if (s1 == 0 && s2 == 0)
      return in_sector(a, b[1]) || in_sector(a, b[2]) || in_sector(b, a[1]) || in_sector(b, a[2]);
    const int r1 = side(b[0], b[1], b[2], a[1]), r2 = side(b[0], b[1], b[2], a[2]);
    return (s1 >= 0 && s2 <= 0 && r1 <= 0 && r2 >= 0) || (s1 <= 0 && s2 >= 0 && r1 >= 0 && r2 <= 0);
  }
  /// Whether a point in the plane of the triangle lies in the sector at its corner 0.
  bool in_sector(const Triangle& t, std::uint32_t point) const {
    return flat_side(t[0], t[1], t[2], point) >= 0 && flat_side(t[0], t[2], t[1], point) >= 0;
  }

  std::vector<Kernel::Point_3> points_;
  const std::vector<Triangle>& triangles_;
};

/// Number of pairs of triangles that meet beyond their common corners and edges, plus the number of triangles
/// without an area. Exact. Needs valid indices.
inline std::size_t count_self_intersections(const SurfaceMesh& surface) {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;
  const ExactTriangles triangles(surface);
  std::vector<Box> boxes;
  std::size_t found = 0;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t)
    if (triangles.flat(t))
      ++found;
    else
      boxes.emplace_back(triangles.box(t), t);
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    if (triangles.meet(a.info(), b.info())) ++found;
  });
  return found;
}

}  // namespace voxtet
