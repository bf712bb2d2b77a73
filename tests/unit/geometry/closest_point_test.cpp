#include "geometry/search/closest_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace voxtet {
namespace {

using Eigen::Vector3d;

class ClosestPoint : public testing::Test {
 protected:
  Vector3d random_point(double scale) {
    return scale * Vector3d(unit_(random_), unit_(random_), unit_(random_));
  }
  std::mt19937 random_{7};
  std::uniform_real_distribution<double> unit_{-1, 1};
};

/// Closest point by sampling barycentric coordinates finely: never closer than the true one.
double sampled_distance(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  double best = std::numeric_limits<double>::max();
  constexpr int n = 60;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j)
      best = std::min(best, (a + (b - a) * i / n + (c - a) * j / n - p).norm());
  return best;
}

TEST_F(ClosestPoint, IsOnTheTriangleAndNoSampleIsCloser) {
  for (int round = 0; round < 300; ++round) {
    const Vector3d a = random_point(1), b = random_point(1), c = random_point(1), p = random_point(2);
    const double distance = (closest_on_triangle(p, a, b, c) - p).norm();
    const double sampled = sampled_distance(p, a, b, c);
    EXPECT_LE(distance, sampled + 1e-12);
    EXPECT_GE(distance, sampled - 0.1);
  }
}

TEST_F(ClosestPoint, TreeAgreesWithBruteForceWhateverTheHint) {
  std::vector<Vector3d> points;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const Vector3d centre = random_point(10);
    for (int k = 0; k < 3; ++k) points.push_back(centre + random_point(1));
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const ClosestPointTree tree(points, triangles);
  for (std::uint32_t round = 0; round < 500; ++round) {
    const Vector3d p = random_point(15);
    double best = std::numeric_limits<double>::max();
    for (const auto& [a, b, c] : triangles)
      best = std::min(best, (closest_on_triangle(p, points[a], points[b], points[c]) - p).norm());
    for (const std::uint32_t hint : {0U, round, 4000000000U}) {
      const ClosestPointTree::Hit hit = tree.closest(p, hint);
      EXPECT_DOUBLE_EQ(hit.distance_mm, best);
      EXPECT_NEAR((hit.point - p).norm(), best, 1e-12);
    }
  }
}

TEST_F(ClosestPoint, TakesTheLowestTriangleOfEquallyCloseOnesWhateverTheHint) {
  // A fan around the origin, seen from above its hub: all triangles are equally close.
  std::vector<Vector3d> points{{0, 0, 0}};
  std::vector<Triangle> triangles;
  for (int i = 0; i < 32; ++i) points.push_back({std::cos(i * 0.2), std::sin(i * 0.2), -1});
  for (std::uint32_t i = 1; i < 32; ++i) triangles.push_back({0, i, i + 1});
  const ClosestPointTree tree(points, triangles);
  for (std::uint32_t hint = 0; hint < triangles.size(); ++hint)
    EXPECT_EQ(tree.closest({0, 0, 2}, hint).triangle, 0U) << hint;
}

TEST_F(ClosestPoint, IsAnyOneNearEnoughWhereThatWillDo) {
  // Two parallel triangles, 1 and 3 below the point.
  const std::vector<Vector3d> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -2}, {1, 0, -2}, {0, 1, -2}};
  const ClosestPointTree tree(points, std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}});
  const Vector3d point(0.2, 0.2, 1);
  EXPECT_DOUBLE_EQ(tree.closest(point, 1, 4).distance_mm, 3);
  EXPECT_DOUBLE_EQ(tree.closest(point, 1, 2).distance_mm, 1);
  EXPECT_DOUBLE_EQ(tree.closest(point, 1).distance_mm, 1);
}

TEST_F(ClosestPoint, IsThatOfTheSegmentOnTrianglesWithTwoEqualCorners) {
  for (int round = 0; round < 200; ++round) {
    const Vector3d a = random_point(1), b = random_point(1), p = random_point(2);
    const double along = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    const double segment = (a + along * (b - a) - p).norm();
    EXPECT_NEAR((closest_on_triangle(p, a, a, b) - p).norm(), segment, 1e-12);
    EXPECT_NEAR((closest_on_triangle(p, a, b, a) - p).norm(), segment, 1e-12);
    EXPECT_NEAR((closest_on_triangle(p, b, a, a) - p).norm(), segment, 1e-12);
    EXPECT_NEAR((closest_on_triangle(p, a, a, a) - p).norm(), (a - p).norm(), 1e-12);
  }
}

TEST_F(ClosestPoint, WorksOnASingleTriangleAndOnManyEqualOnes) {
  const std::vector<Vector3d> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const std::size_t count : {1U, 100U}) {
    const ClosestPointTree tree(points, std::vector<Triangle>(count, Triangle{0, 1, 2}));
    EXPECT_DOUBLE_EQ(tree.closest({0.2, 0.2, 3}).distance_mm, 3);
  }
}

}  // namespace
}  // namespace voxtet
