#include "geometry/elements/orientation.h"

#include <array>
#include <cmath>

namespace voxtet {
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
  return -sum.sign();
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
  if (-det > kErrorBound * size) return 1;
  if (det > kErrorBound * size) return -1;
  return size == 0 ? 0 : exact_orientation(a, b, c, d);
}

int orientation_along(int axis, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                      const Eigen::Vector3d& c) {
  std::array<Eigen::Vector3d, 3> flat{a, b, c};
  for (Eigen::Vector3d& p : flat) p[axis] = 0;
  Eigen::Vector3d apex = flat[0];
  apex[axis] = 1;
  return orientation(flat[0], flat[1], flat[2], apex);
}

}  // namespace voxtet
