#include "geometry/intersect/triangle_intersection.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "geometry/elements/half_space.h"
#include "geometry/elements/orientation.h"

namespace voxtet {
namespace {

using Points = std::vector<Eigen::Vector3d>;

TriangleCorners corners_of(const Points& points, const Triangle& t) {
  return {points[t[0]], points[t[1]], points[t[2]]};
}

/// An axis along which the triangle has an area.
int open_axis(const TriangleCorners& t) {
  int axis = 0;
  while (axis < 2 && orientation_along(axis, t[0], t[1], t[2]) == 0) ++axis;
  return axis;
}

/// Segment and triangle in one plane.
bool meet_in_plane(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const TriangleCorners& t) {
  const int axis = open_axis(t);
  const int turn = orientation_along(axis, t[0], t[1], t[2]);
  bool has_p = true, has_q = true, crosses_edge = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d &u = t[i], &w = t[(i + 1) % 3];
    const int side_p = turn * orientation_along(axis, u, w, p);
    const int side_q = turn * orientation_along(axis, u, w, q);
    has_p = has_p && side_p >= 0;
    has_q = has_q && side_q >= 0;
    if (side_p * side_q > 0 || (side_p == 0 && side_q == 0)) continue;
    crosses_edge = crosses_edge || orientation_along(axis, p, q, u) * orientation_along(axis, p, q, w) <= 0;
  }
  return has_p || has_q || crosses_edge;
}

/// Do segment and triangle meet? `side_p` and `side_q`: orientations of p and q against t.
bool crosses(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const TriangleCorners& t, int side_p,
             int side_q) {
  if (side_p * side_q > 0) return false;
  if (side_p == 0 && side_q == 0) return meet_in_plane(p, q, t);
  const int first = orientation(p, q, t[0], t[1]);
  const int second = orientation(p, q, t[1], t[2]);
  if (first * second < 0) return false;
  const int third = orientation(p, q, t[2], t[0]);
  return first * third >= 0 && second * third >= 0;
}

/// Does the edge opposite the first corner meet the other triangle?
bool far_edge_meets(const TriangleCorners& a, const TriangleCorners& b) {
  return crosses(a[1], a[2], b, orientation(b[0], b[1], b[2], a[1]), orientation(b[0], b[1], b[2], a[2]));
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
  if (orientation(p, q, r, s) != 0) return false;
  const int axis = open_axis({p, q, r});
  return orientation_along(axis, p, q, r) * orientation_along(axis, p, q, s) > 0;
}

}  // namespace

bool triangles_meet(const TriangleCorners& a, const TriangleCorners& b) {
  Vectors<9> v;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) v.set(3 * i + j, a[i], b[j]);
  if (in_open_half_space(v)) return false;
  std::array<int, 3> side_b{}, side_a{};
  for (std::size_t i = 0; i < 3; ++i) side_b[i] = orientation(a[0], a[1], a[2], b[i]);
  if (side_b[0] != 0 && side_b[0] == side_b[1] && side_b[1] == side_b[2]) return false;
  for (std::size_t i = 0; i < 3; ++i) side_a[i] = orientation(b[0], b[1], b[2], a[i]);
  if (side_a[0] != 0 && side_a[0] == side_a[1] && side_a[1] == side_a[2]) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (crosses(b[i], b[j], a, side_b[i], side_b[j]) || crosses(a[i], a[j], b, side_a[i], side_a[j]))
      return true;
  }
  return false;
}

bool triangles_meet_beyond_corner(const TriangleCorners& a, const TriangleCorners& b) {
  Vectors<4> v;
  v.set(0, a[1], a[0]);
  v.set(1, a[2], a[0]);
  v.set(2, a[0], b[1]);
  v.set(3, a[0], b[2]);
  if (in_open_half_space(v)) return false;
  // A common point beyond the corner, pushed away from it, stays common until it meets an opposite edge.
  return far_edge_meets(b, a) || far_edge_meets(a, b);
}

bool triangles_intersect(const Points& points, const Triangle& first, const Triangle& second) {
  Triangle a = first, b = second;
  switch (move_shared_to_front(a, b)) {
    case 3: return true;
    case 2: return fold_over(points[a[0]], points[a[1]], points[a[2]], points[b[2]]);
    case 1: return triangles_meet_beyond_corner(corners_of(points, a), corners_of(points, b));
    default: return triangles_meet(corners_of(points, a), corners_of(points, b));
  }
}

}  // namespace voxtet
