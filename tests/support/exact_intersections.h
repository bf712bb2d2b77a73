// A second opinion on self-intersections: exact, by CGAL's predicates, and apart from core/geometry.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "types/surface_mesh.h"

namespace voxtet::test {

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
  /// Whether two triangles with an area have more in common than the simplex of their common corners.
  bool meet(std::uint32_t t, std::uint32_t s) const {
    std::vector<std::uint32_t> common, of_t, of_s;
    for (const std::uint32_t v : triangles_[t]) (has(s, v) ? common : of_t).push_back(v);
    for (const std::uint32_t v : triangles_[s])
      if (!has(t, v)) of_s.push_back(v);
    if (common.empty()) return CGAL::do_intersect(solid(t), solid(s));
    if (common.size() == 1) return sectors_meet(common[0], of_t, of_s);
    return common.size() == 3 || folded(common[0], common[1], of_t[0], of_s[0]);
  }
  CGAL::Bbox_3 box(std::uint32_t t) const { return solid(t).bbox(); }

 private:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Corners = std::vector<std::uint32_t>;

  bool has(std::uint32_t t, std::uint32_t v) const {
    return std::find(triangles_[t].begin(), triangles_[t].end(), v) != triangles_[t].end();
  }
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
  bool folded(std::uint32_t p, std::uint32_t q, std::uint32_t r, std::uint32_t s) const {
    return side(p, q, r, s) == 0 && flat_side(p, q, r, s) > 0;
  }
  /// Two triangles with the corner v in common meet elsewhere just when the sectors that they span at v do.
  /// With vectors from v, r2 a1 - r1 a2 = s1 b2 - s2 b1 (Cramer; the coefficients are the determinants
  /// below), and no other combination of the a's is one of the b's: the sectors share a ray where all four
  /// coefficients can be made nonnegative.
  bool sectors_meet(std::uint32_t v, const Corners& a, const Corners& b) const {
    const int s1 = side(v, a[0], a[1], b[0]), s2 = side(v, a[0], a[1], b[1]);
    const int r1 = side(v, b[0], b[1], a[0]), r2 = side(v, b[0], b[1], a[1]);
    if (s1 == 0 && s2 == 0)
      return in_sector(v, a, b[0]) || in_sector(v, a, b[1]) || in_sector(v, b, a[0]) || in_sector(v, b, a[1]);
    return (s1 >= 0 && s2 <= 0 && r1 <= 0 && r2 >= 0) || (s1 <= 0 && s2 >= 0 && r1 >= 0 && r2 <= 0);
  }
  /// For a point in the plane of the sector.
  bool in_sector(std::uint32_t v, const Corners& sector, std::uint32_t p) const {
    return flat_side(v, sector[0], sector[1], p) >= 0 && flat_side(v, sector[1], sector[0], p) >= 0;
  }

  std::vector<Kernel::Point_3> points_;
  const std::vector<Triangle>& triangles_;
};

/// Number of pairs of triangles that meet elsewhere than in their common corners, and of triangles without
/// an area. Exact. Needs valid indices.
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

}  // namespace voxtet::test
