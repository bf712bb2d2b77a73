#include "geometry/intersect/triangle_intersection.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "geometry/elements/half_space.h"
#include "support/exact_intersection.h"
#include "support/test_random.h"

namespace voxtet {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Triangle random_triangle(test::TestRandom& random, int points) {
  const auto a = static_cast<std::uint32_t>(random.below(points));
  std::uint32_t b = a, c = a;
  while (b == a) b = static_cast<std::uint32_t>(random.below(points));
  while (c == a || c == b) c = static_cast<std::uint32_t>(random.below(points));
  return {a, b, c};
}

/// The corners in turn, beginning with `first`.
TriangleCorners corners_from(const Points& points, const Triangle& t, std::uint32_t first) {
  const auto i = static_cast<std::size_t>(std::find(t.begin(), t.end(), first) - t.begin());
  return {points[t[i]], points[t[(i + 1) % 3]], points[t[(i + 2) % 3]]};
}

/// What the tests by corners say of triangles with at most one common corner.
bool corners_meet(const Points& points, const Triangle& a, const Triangle& b) {
  for (const std::uint32_t v : a)
    if (std::find(b.begin(), b.end(), v) != b.end())
      return triangles_meet_beyond_corner(corners_from(points, a, v), corners_from(points, b, v));
  return triangles_meet(corners_from(points, a, a[0]), corners_from(points, b, b[0]));
}

/// Pairs by the oracle's word.
struct Tally {
  int meeting = 0, apart = 0;
};

void compare(test::TestRandom& random, const Points& points, int pairs, std::array<Tally, 3>& tally) {
  for (int i = 0; i < pairs; ++i) {
    const Triangle a = random_triangle(random, static_cast<int>(points.size()));
    const Triangle b = random_triangle(random, static_cast<int>(points.size()));
    if (!test::has_area(points, a) || !test::has_area(points, b)) continue;
    std::size_t shared = 0;
    for (const std::uint32_t v : a) shared += std::find(b.begin(), b.end(), v) != b.end() ? 1 : 0;
    if (shared == 3) continue;
    const bool expected = test::meet_beyond_shared(points, a, b);
    ASSERT_EQ(triangles_intersect(points, a, b), expected);
    ASSERT_EQ(triangles_intersect(points, b, a), expected);
    if (shared < 2) {
      ASSERT_EQ(corners_meet(points, a, b), expected);
    }
    ++(expected ? tally[shared].meeting : tally[shared].apart);
  }
}

void expect_all_met(const std::array<Tally, 3>& tally) {
  for (std::size_t shared = 0; shared < 3; ++shared) {
    EXPECT_GT(tally[shared].meeting, 20) << shared;
    EXPECT_GT(tally[shared].apart, 20) << shared;
  }
}

// On a 3 x 3 x 3 lattice nearly everything is coplanar, touching, collinear or duplicated.
TEST(TrianglesIntersect, AgreesWithExactConstructionOnALattice) {
  test::TestRandom random(7);
  std::array<Tally, 3> tally;
  for (int round = 0; round < 60; ++round) {
    Points points;
    for (int i = 0; i < 9; ++i)
      points.push_back(Eigen::Vector3d{1.0 * random.below(3), 1.0 * random.below(3),
                                       round % 3 == 0 ? 0.0 : random.below(3)});
    compare(random, points, 20, tally);
  }
  expect_all_met(tally);
}

TEST(TrianglesIntersect, AgreesWithExactConstructionUnderRounding) {
  test::TestRandom random(8);
  std::array<Tally, 3> tally;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.9, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  for (int round = 0; round < 60; ++round) {
    Points points;
    for (int i = 0; i < 9; ++i)
      points.push_back(turn * Eigen::Vector3d{1.0 * random.below(3), 1.0 * random.below(3),
                                              round % 3 == 0 ? 0.1 : 0.3 * random.below(3)} +
                       Eigen::Vector3d(-120, 340, 55));
    compare(random, points, 20, tally);
  }
  expect_all_met(tally);
}

TEST(TrianglesIntersect, AgreesWithExactConstructionOnThinTriangles) {
  test::TestRandom random(9);
  std::array<Tally, 3> tally;
  const auto tiny = [&] { return (random.below(3) - 1) * 1e-9; };
  for (int round = 0; round < 60; ++round) {
    Points points;
    for (int i = 0; i < 9; ++i)
      points.push_back(Eigen::Vector3d{random.below(4) + tiny(), random.below(2) + tiny(), tiny()});
    compare(random, points, 20, tally);
  }
  for (std::size_t shared = 1; shared < 3; ++shared) EXPECT_GT(tally[shared].apart, 20) << shared;
}

TEST(InOpenHalfSpace, NeverPassesVectorsAroundTheOrigin) {
  test::TestRandom random(10);
  for (int i = 0; i < 2000; ++i) {
    // Three random vectors and minus a positive combination of them.
    Vectors<4> v;
    const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    Eigen::Vector3d sum = origin;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d r{random.below(64) - 32.0, random.below(64) - 32.0, random.below(64) - 32.0};
      v.set(k, r, origin);
      sum += (1 + random.below(8)) * r;
    }
    v.set(3, origin, sum);
    ASSERT_FALSE(in_open_half_space(v));
  }
}

TEST(InOpenHalfSpace, FindsTheSideOfAWideFan) {
  Vectors<4> v;
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  v.set(0, Eigen::Vector3d(10, 0, 0.5), origin);
  v.set(1, Eigen::Vector3d(-1, 0, 0.5), origin);
  v.set(2, Eigen::Vector3d(0, 3, 0.5), origin);
  v.set(3, Eigen::Vector3d(0, -0.1, 0.5), origin);
  EXPECT_TRUE(in_open_half_space(v));
}

TEST(InOpenHalfSpace, HoldsTheDistanceOfTheHull) {
  Vectors<3> v;
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  v.set(0, Eigen::Vector3d(1, 0, 0.25), origin);
  v.set(1, Eigen::Vector3d(-1, 1, 0.25), origin);
  v.set(2, Eigen::Vector3d(-1, -1, 0.25), origin);
  EXPECT_TRUE(in_open_half_space(v, 0.2));
  EXPECT_FALSE(in_open_half_space(v, 0.26));
}

}  // namespace
}  // namespace voxtet
