#include "remesh/triangle_contact.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>

#include "geometry/closest_point.h"

namespace voxtet::remesh {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 exact(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}
Kernel::Triangle_3 exact(const Corners& t) {
  return {exact(t[0]), exact(t[1]), exact(t[2])};
}

/// `side_p` and `side_q`: orientations of p and q against t.
bool crosses(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Corners& t, int side_p, int side_q) {
  if (side_p * side_q > 0) return false;
  if (side_p == 0 && side_q == 0) return CGAL::do_intersect(Kernel::Segment_3(exact(p), exact(q)), exact(t));
  const int first = orientation(p, q, t[0], t[1]);
  const int second = orientation(p, q, t[1], t[2]);
  if (first * second < 0) return false;
  const int third = orientation(p, q, t[2], t[0]);
  return first * third >= 0 && second * third >= 0;
}

}  // namespace

int orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                const Eigen::Vector3d& d) {
  constexpr double kErrorBound = 8e-16;  // Shewchuk's (7 + 56 eps) eps, rounded up
  const double ax = a[0] - d[0], ay = a[1] - d[1], az = a[2] - d[2];
  const double bx = b[0] - d[0], by = b[1] - d[1], bz = b[2] - d[2];
  const double cx = c[0] - d[0], cy = c[1] - d[1], cz = c[2] - d[2];
  const double bxcy = bx * cy, cxby = cx * by, cxay = cx * ay, axcy = ax * cy, axby = ax * by, bxay = bx * ay;
  const double det = az * (bxcy - cxby) + bz * (cxay - axcy) + cz * (axby - bxay);
  const double size = (std::abs(bxcy) + std::abs(cxby)) * std::abs(az) +
                      (std::abs(cxay) + std::abs(axcy)) * std::abs(bz) +
                      (std::abs(axby) + std::abs(bxay)) * std::abs(cz);
  if (det > kErrorBound * size) return 1;
  if (-det > kErrorBound * size) return -1;
  return -static_cast<int>(CGAL::orientation(exact(a), exact(b), exact(c), exact(d)));
}

bool segment_meets_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Corners& t) {
  return crosses(p, q, t, orientation(t[0], t[1], t[2], p), orientation(t[0], t[1], t[2], q));
}

bool triangles_meet(const Corners& a, const Corners& b) {
  std::array<int, 3> side_b{}, side_a{};
  for (int i = 0; i < 3; ++i) side_b[i] = orientation(a[0], a[1], a[2], b[i]);
  if (side_b[0] != 0 && side_b[0] == side_b[1] && side_b[1] == side_b[2]) return false;
  for (int i = 0; i < 3; ++i) side_a[i] = orientation(b[0], b[1], b[2], a[i]);
  if (side_a[0] != 0 && side_a[0] == side_a[1] && side_a[1] == side_a[2]) return false;
  if (side_b[0] == 0 && side_b[1] == 0 && side_b[2] == 0) return CGAL::do_intersect(exact(a), exact(b));
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (crosses(b[i], b[j], a, side_b[i], side_b[j]) || crosses(a[i], a[j], b, side_a[i], side_a[j]))
      return true;
  }
  return false;
}

bool triangles_meet_beyond_corner(const Corners& a, const Corners& b) {
  return segment_meets_triangle(b[1], b[2], a) || segment_meets_triangle(a[1], a[2], b);
}

double corner_distance2(const Corners& a, const Corners& b) {
  double least = (a[0] - b[0]).squaredNorm();
  for (int i = 0; i < 3; ++i) {
    least = std::min(least, (closest_on_triangle(a[i], b[0], b[1], b[2]) - a[i]).squaredNorm());
    least = std::min(least, (closest_on_triangle(b[i], a[0], a[1], a[2]) - b[i]).squaredNorm());
  }
  return least;
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

double sharpest_cosine(const Corners& t) {
  double a = (t[1] - t[2]).squaredNorm(), b = (t[2] - t[0]).squaredNorm(), c = (t[0] - t[1]).squaredNorm();
  if (a > b) std::swap(a, b);
  if (a > c) std::swap(a, c);
  const double size = 2 * std::sqrt(b * c);
  return size > 0 ? (b + c - a) / size : 1;
}

}  // namespace voxtet::remesh
