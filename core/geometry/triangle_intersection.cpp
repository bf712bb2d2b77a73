#include "geometry/triangle_intersection.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "geometry/half_space.h"

namespace voxtet {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Points = std::vector<Eigen::Vector3d>;

Kernel::Point_3 exact(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

Kernel::Triangle_3 exact(const Points& points, const Triangle& t) {
  return {exact(points[t[0]]), exact(points[t[1]]), exact(points[t[2]])};
}

/// Common corners come first in both, in the same order.
int move_shared_to_front(Triangle& a, Triangle& b) {
  int shared = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = shared; j < 3; ++j)
      if (a[i] == b[j]) {
        std::swap(a[i], a[shared]);
        std::swap(b[j], b[shared]);
        ++shared;
        break;
      }
  return shared;
}

/// Triangles on the edge p-q overlap only if their apexes r and s lie in one plane with it and on one side.
bool fold_over(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
               const Eigen::Vector3d& s) {
  // The normals of a fold point the same way. Each of their components is off by at most four roundings of
  // twice the product of the largest components; the bound has room to spare.
  const Eigen::Vector3d e = q - p, f = r - p, g = s - p;
  const double size = e.cwiseAbs().maxCoeff();
  const double bound = 1e-13 * size * size * f.cwiseAbs().maxCoeff() * g.cwiseAbs().maxCoeff();
  if (e.cross(f).dot(e.cross(g)) < -(bound + 1e-280)) return false;
  const Kernel::Point_3 a = exact(p), b = exact(q), c = exact(r), d = exact(s);
  return CGAL::coplanar(a, b, c, d) && CGAL::coplanar_orientation(a, b, c, d) == CGAL::POSITIVE;
}

bool meet_beyond_corner(const Points& points, const Triangle& a, const Triangle& b) {
  Vectors<4> v;
  v.set(0, points[a[1]], points[a[0]]);
  v.set(1, points[a[2]], points[a[0]]);
  v.set(2, points[a[0]], points[b[1]]);
  v.set(3, points[a[0]], points[b[2]]);
  if (in_open_half_space(v)) return false;
  // A common point beyond the corner, pushed away from it, stays common until it meets an opposite edge.
  return CGAL::do_intersect(exact(points, a), Kernel::Segment_3(exact(points[b[1]]), exact(points[b[2]]))) ||
         CGAL::do_intersect(exact(points, b), Kernel::Segment_3(exact(points[a[1]]), exact(points[a[2]])));
}

bool meet(const Points& points, const Triangle& a, const Triangle& b) {
  Vectors<9> v;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) v.set(3 * i + j, points[a[i]], points[b[j]]);
  return !in_open_half_space(v) && CGAL::do_intersect(exact(points, a), exact(points, b));
}

}  // namespace

bool triangles_intersect(const Points& points, const Triangle& first, const Triangle& second) {
  Triangle a = first, b = second;
  switch (move_shared_to_front(a, b)) {
    case 3: return true;
    case 2: return fold_over(points[a[0]], points[a[1]], points[a[2]], points[b[2]]);
    case 1: return meet_beyond_corner(points, a, b);
    default: return meet(points, a, b);
  }
}

}  // namespace voxtet
