#include "remesh/triangle_contact.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/closest_point.h"

namespace voxtet::remesh {
namespace {

/// A sum of doubles that is kept exactly (Shewchuk 1997: two-sum, two-product by Dekker's split, growing an
/// expansion). Components ascend in size, so the last one has the sign.
class ExactSum {
 public:
  void add_product(double a, double b, double c) {
    double tail = 0, low = 0;
    const double head = two_product(a, b, tail);
    for (const double part : {tail, head}) {
      const double high = two_product(part, c, low);
      add(low);
      add(high);
    }
  }
  int sign() const { return size_ == 0 ? 0 : parts_[size_ - 1] > 0 ? 1 : -1; }

 private:
  static double two_product(double a, double b, double& tail) {
    constexpr double kSplitter = 134217729;  // 2^27 + 1
    const double product = a * b;
    const double ca = kSplitter * a, cb = kSplitter * b;
    const double ah = ca - (ca - a), bh = cb - (cb - b);
    const double al = a - ah, bl = b - bh;
    tail = al * bl - (((product - ah * bh) - al * bh) - ah * bl);
    return product;
  }
  void add(double x) {
    if (x == 0) return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const double sum = x + parts_[i];
      const double virtual_part = sum - x;
      const double tail = (x - (sum - virtual_part)) + (parts_[i] - virtual_part);
      if (tail != 0) parts_[kept++] = tail;
      x = sum;
    }
    if (x != 0) parts_[kept++] = x;
    size_ = kept;
  }

  std::array<double, 200>
      parts_;  // 6 products of three differences of two parts each, four doubles a product
  std::size_t size_ = 0;
};

/// a - b as two doubles, exactly.
std::array<double, 2> exact_difference(double a, double b) {
  const double x = a - b;
  const double virtual_b = a - x;
  return {(a - (x + virtual_b)) + (virtual_b - b), x};
}

int exact_orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                      const Eigen::Vector3d& d) {
  std::array<std::array<std::array<double, 2>, 3>, 3> m;  // row, column, part
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    m[0][k] = exact_difference(a[axis], d[axis]);
    m[1][k] = exact_difference(b[axis], d[axis]);
    m[2][k] = exact_difference(c[axis], d[axis]);
  }
  ExactSum sum;
  for (std::size_t k = 0; k < 3; ++k)
    for (const int turn : {1, 2})
      for (const double x : m[0][k])
        for (const double y : m[1][(k + static_cast<std::size_t>(turn)) % 3])
          for (const double z : m[2][(k + static_cast<std::size_t>(3 - turn)) % 3])
            sum.add_product(turn == 1 ? x : -x, y, z);
  return sum.sign();
}

int orientation_2d(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, int axis) {
  std::array<Eigen::Vector3d, 3> flat{a, b, c};
  for (Eigen::Vector3d& p : flat) p[axis] = 0;
  Eigen::Vector3d apex = flat[0];
  apex[axis] = 1;
  return orientation(flat[0], flat[1], flat[2], apex);
}

/// Segment and triangle in one plane.
bool meet_in_plane(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Corners& t) {
  int axis = 0;
  while (axis < 2 && orientation_2d(t[0], t[1], t[2], axis) == 0) ++axis;
  const int turn = orientation_2d(t[0], t[1], t[2], axis);
  bool has_p = true, has_q = true, crosses_edge = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d &u = t[i], &w = t[(i + 1) % 3];
    const int side_p = turn * orientation_2d(u, w, p, axis), side_q = turn * orientation_2d(u, w, q, axis);
    has_p = has_p && side_p >= 0;
    has_q = has_q && side_q >= 0;
    if (side_p * side_q > 0 || (side_p == 0 && side_q == 0)) continue;
    crosses_edge = crosses_edge || orientation_2d(p, q, u, axis) * orientation_2d(p, q, w, axis) <= 0;
  }
  return has_p || has_q || crosses_edge;
}

/// `side_p` and `side_q`: orientations of p and q against t.
bool crosses(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Corners& t, int side_p, int side_q) {
  if (side_p * side_q > 0) return false;
  if (side_p == 0 && side_q == 0) return meet_in_plane(p, q, t);
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
  return size == 0 ? 0 : exact_orientation(a, b, c, d);
}

bool segment_meets_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Corners& t) {
  return crosses(p, q, t, orientation(t[0], t[1], t[2], p), orientation(t[0], t[1], t[2], q));
}

bool triangles_meet(const Corners& a, const Corners& b) {
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
