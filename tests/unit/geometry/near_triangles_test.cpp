#include "geometry/search/near_triangles.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "geometry/search/closest_point.h"

namespace voxtet {
namespace {

using Eigen::Vector3d;

class NearTriangles : public testing::Test {
 protected:
  Vector3d random_point(const Vector3d& scale) {
    return scale.cwiseProduct(Vector3d(unit_(random_), unit_(random_), unit_(random_)));
  }
  void add_triangles(std::size_t count, const Vector3d& scale, double size) {
    for (std::size_t i = 0; i < count; ++i) {
      const Vector3d centre = random_point(scale);
      const auto first = static_cast<std::uint32_t>(corners_.size());
      for (int k = 0; k < 3; ++k) corners_.push_back(centre + random_point(Vector3d::Constant(size)));
      triangles_.push_back({first, first + 1, first + 2});
      kinds_.push_back(static_cast<std::uint32_t>(i % 3));
    }
  }
  void add_queries(std::size_t count, const Vector3d& scale, double most_mm) {
    for (std::size_t i = 0; i < count; ++i)
      queries_.push_back({random_point(scale), most_mm * std::abs(unit_(random_)),
                          static_cast<std::uint32_t>(random_() % 4)});
  }
  double distance(const NearQuery& query, std::uint32_t t) const {
    const auto& [a, b, c] = triangles_[t];
    return (closest_on_triangle(query.point, corners_[a], corners_[b], corners_[c]) - query.point).norm();
  }
  /// How many were within their limits.
  std::size_t expect_as_by_brute_force() const {
    const std::vector<NearTriangle> found = near_triangles(queries_, corners_, triangles_, kinds_);
    EXPECT_EQ(found.size(), queries_.size());
    std::size_t within = 0;
    for (std::size_t q = 0; q < queries_.size(); ++q) {
      NearTriangle expected;
      double best = std::numeric_limits<double>::max();
      for (std::uint32_t t = 0; t < triangles_.size() && !expected.within; ++t) {
        if (kinds_[t] != queries_[q].kind) continue;
        const double away = distance(queries_[q], t);
        if (away < best) expected.triangle = t;
        best = std::min(best, away);
        if (away <= queries_[q].limit_mm) expected = {t, true};
      }
      EXPECT_EQ(found[q].triangle, expected.triangle) << q;
      EXPECT_EQ(found[q].within, expected.within) << q;
      within += expected.within ? 1 : 0;
    }
    return within;
  }

  std::vector<Vector3d> corners_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> kinds_;
  std::vector<NearQuery> queries_;
  std::mt19937 random_{11};
  std::uniform_real_distribution<double> unit_{-1, 1};
};

TEST_F(NearTriangles, AreThoseThatBruteForceFinds) {
  add_triangles(400, Vector3d(10, 10, 10), 1);
  add_queries(600, Vector3d(12, 12, 12), 3);
  const std::size_t within = expect_as_by_brute_force();
  EXPECT_GT(within, 100U);
  EXPECT_LT(within, 400U);
}

TEST_F(NearTriangles, OfPointsInAPlaneOnALineAndOfASinglePoint) {
  add_triangles(100, Vector3d(10, 10, 1), 2);
  for (const Vector3d& scale : {Vector3d(10, 10, 0), Vector3d(0, 10, 0)}) {
    queries_.clear();
    add_queries(200, scale, 2);
    EXPECT_GT(expect_as_by_brute_force(), 10U);
  }
  queries_ = {{corners_[0], 0, kinds_[0]}};
  EXPECT_EQ(expect_as_by_brute_force(), 1U);
}

TEST_F(NearTriangles, OfNoTrianglesOrNoPointsAreNone) {
  EXPECT_TRUE(near_triangles(queries_, corners_, triangles_, kinds_).empty());
  add_queries(3, Vector3d(1, 1, 1), 1);
  EXPECT_EQ(expect_as_by_brute_force(), 0U);
}

/// Larger triangles than cells, and points far away from all of them.
TEST_F(NearTriangles, ReachOverManyCells) {
  add_triangles(30, Vector3d(100, 100, 100), 60);
  add_queries(500, Vector3d(100, 100, 100), 40);
  add_queries(5, Vector3d(1e4, 1e4, 1e4), 10);
  EXPECT_GT(expect_as_by_brute_force(), 20U);
}

}  // namespace
}  // namespace voxtet
