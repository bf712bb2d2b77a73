// Signs against exact rational arithmetic, mostly where rounding decides.
#include "geometry/elements/orientation.h"

#include <gtest/gtest.h>

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "geometry/elements/tet_measures.h"
#include "support/test_random.h"

namespace voxtet {
namespace {

using Eigen::Vector3d;
using Rational = boost::multiprecision::cpp_rational;
using RationalVector = std::array<Rational, 3>;

RationalVector difference(const Vector3d& to, const Vector3d& from) {
  return {Rational(to[0]) - Rational(from[0]), Rational(to[1]) - Rational(from[1]),
          Rational(to[2]) - Rational(from[2])};
}
Rational minor(const RationalVector& u, const RationalVector& v, std::size_t axis) {
  const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
  return u[x] * v[y] - u[y] * v[x];
}
int exact_side(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const RationalVector u = difference(b, a), v = difference(c, a), w = difference(d, a);
  return Rational(minor(u, v, 0) * w[0] + minor(u, v, 1) * w[1] + minor(u, v, 2) * w[2]).sign();
}

/// Numbers of the signs seen.
struct Signs {
  int negative = 0, zero = 0, positive = 0;
};

void compare(const std::array<Vector3d, 4>& p, Signs& signs) {
  const int expected = exact_side(p[0], p[1], p[2], p[3]);
  ++(expected < 0 ? signs.negative : expected > 0 ? signs.positive : signs.zero);
  ASSERT_EQ(orientation(p[0], p[1], p[2], p[3]), expected);
  ASSERT_EQ(orientation(p[3], p[0], p[1], p[2]), -expected);
  ASSERT_EQ(orientation(p[2], p[3], p[0], p[1]), expected);
  for (int axis = 0; axis < 3; ++axis)
    ASSERT_EQ(orientation_along(axis, p[0], p[1], p[2]),
              minor(difference(p[1], p[0]), difference(p[2], p[0]), static_cast<std::size_t>(axis)).sign());
}

/// A whole number below 2^bits, of either sign.
double whole(test::TestRandom& random, int bits) {
  const double size = static_cast<double>(random.next() >> (64 - bits));
  return random.below(2) ? size : -size;
}

TEST(Orientation, IsTheSignOfTheVolumeOfATetrahedron) {
  const TetCorners p{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1)};
  EXPECT_GT(tet_volume_mm3(p), 0);
  EXPECT_EQ(orientation(p[0], p[1], p[2], p[3]), 1);
  EXPECT_EQ(orientation(p[1], p[0], p[2], p[3]), -1);
  EXPECT_EQ(orientation_along(2, p[0], p[1], p[2]), 1);
  EXPECT_EQ(orientation_along(2, p[1], p[0], p[2]), -1);
}

TEST(Orientation, IsThatOfRationalsOnPointsInGeneralPosition) {
  test::TestRandom random(1);
  Signs signs;
  for (int round = 0; round < 500; ++round) {
    std::array<Vector3d, 4> p;
    for (Vector3d& q : p)
      for (int d = 0; d < 3; ++d) q[d] = whole(random, 53) * 1e-13;
    compare(p, signs);
  }
  EXPECT_GT(signs.negative, 100);
  EXPECT_GT(signs.positive, 100);
}

// Tenths are not exact in binary: most of these points are just beside the plane or line of the others.
TEST(Orientation, IsThatOfRationalsOnALatticeOfTenths) {
  test::TestRandom random(2);
  Signs signs;
  for (int round = 0; round < 3000; ++round) {
    std::array<Vector3d, 4> p;
    for (Vector3d& q : p)
      for (int d = 0; d < 3; ++d) q[d] = 0.3 + 0.1 * random.below(4);
    compare(p, signs);
  }
  EXPECT_GT(signs.negative, 100);
  EXPECT_GT(signs.zero, 100);
  EXPECT_GT(signs.positive, 100);
}

TEST(Orientation, SeesOneUnitInTheLastPlace) {
  test::TestRandom random(3);
  Signs signs;
  for (int round = 0; round < 1000; ++round) {
    // d = a + i u + j v in whole numbers that fit: exactly in the plane, or on a line when u is along v.
    std::array<Vector3d, 4> p;
    Vector3d u, v;
    for (int d = 0; d < 3; ++d) {
      p[0][d] = whole(random, 48);
      u[d] = whole(random, 45);
      v[d] = round % 4 == 0 ? 2 * u[d] : whole(random, 45);
    }
    p[1] = p[0] + u;
    p[2] = p[0] + v;
    const int along_u = random.below(9) - 4, along_v = random.below(9) - 4;
    p[3] = p[0] + along_u * u + along_v * v;
    if (round % 2)
      for (int d = 0; d < 3; ++d) p[3][d] = std::nextafter(p[3][d], whole(random, 60));
    for (Vector3d& q : p) q *= 0x1p-40;
    compare(p, signs);
  }
  EXPECT_GT(signs.negative, 100);
  EXPECT_GT(signs.zero, 300);
  EXPECT_GT(signs.positive, 100);
}

TEST(Orientation, IsThatOfRationalsOnTinyAndHugeCoordinatesTogether) {
  test::TestRandom random(4);
  Signs signs;
  const std::array<double, 6> scales{0, 1e-75, 1e-20, 1, 1e20, 1e98};
  for (int round = 0; round < 1000; ++round) {
    std::array<Vector3d, 4> p;
    for (Vector3d& q : p)
      for (int d = 0; d < 3; ++d)
        q[d] = scales[static_cast<std::size_t>(random.below(6))] * (random.below(61) - 30);
    compare(p, signs);
  }
  EXPECT_GT(signs.negative, 100);
  EXPECT_GT(signs.zero, 0);
  EXPECT_GT(signs.positive, 100);
}

}  // namespace
}  // namespace voxtet
