#include "geometry/grid/fast_sweeping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <tuple>

#include "geometry/elements/rotation.h"

namespace voxtet {
namespace {

using Size = std::array<int, 3>;

struct SweptGrid {
  Size size{};
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();

  std::size_t count() const { return static_cast<std::size_t>(size[0]) * size[1] * size[2]; }
  std::size_t offset(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(size[0]) * (j + static_cast<std::size_t>(size[1]) * k);
  }
  /// Calls visit(i, j, k, offset).
  template <class Visit>
  void for_each(Visit visit) const {
    for (int k = 0; k < size[2]; ++k)
      for (int j = 0; j < size[1]; ++j)
        for (int i = 0; i < size[0]; ++i) visit(i, j, k, offset(i, j, k));
  }
};

SweptGrid orthogonal_grid(const Size& size, const Eigen::Vector3d& spacing) {
  return {size, rotation_from_degrees({25, -40, 65}) * spacing.asDiagonal()};
}

SweptGrid sheared_grid(const Size& size) {
  SweptGrid grid{size, Eigen::Matrix3d::Identity()};
  grid.linear.col(1) = Eigen::Vector3d(0.35, 1.1, 0);
  grid.linear.col(2) = Eigen::Vector3d(-0.2, 0.3, 1.3);
  return grid;
}

/// The largest |h(a) - h(b)| / (g |a - b|) over the 26 neighbours of all points.
double steepest(const SweptGrid& grid, double gradation, const std::vector<float>& h) {
  double most = 0;
  grid.for_each([&](int i, int j, int k, std::size_t at) {
    for (int dk = -1; dk <= 1; ++dk)
      for (int dj = -1; dj <= 1; ++dj)
        for (int di = -1; di <= 1; ++di) {
          const int a = i + di, b = j + dj, c = k + dk;
          if (a < 0 || b < 0 || c < 0 || a >= grid.size[0] || b >= grid.size[1] || c >= grid.size[2])
            continue;
          const double length = (grid.linear * Eigen::Vector3d(di, dj, dk)).norm();
          if (length == 0) continue;
          most = std::max(most, std::abs(h[at] - h[grid.offset(a, b, c)]) / (gradation * length));
        }
  });
  return most;
}

std::vector<float> random_sizes(const SweptGrid& grid, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<float> h(grid.count());
  for (float& value : h)
    value = random() % 40 == 0 ? 0.5F + 0.001F * static_cast<float>(random() % 2000) : 20.F;
  return h;
}

std::vector<float> limited(const SweptGrid& grid, double gradation, std::vector<float> h) {
  EXPECT_TRUE(limit_gradation(grid.size, grid.linear, gradation, h, RunContext{}));
  return h;
}

TEST(LimitGradation, BoundsTheSlopeBetweenAllNeighboursAndNeverRises) {
  const std::vector<SweptGrid> grids{orthogonal_grid({30, 25, 20}, {1, 1, 1}),
                                     orthogonal_grid({17, 31, 9}, {0.7, 1.1, 3.3}),
                                     sheared_grid({20, 20, 20}), orthogonal_grid({1, 12, 1}, {1, 2, 3}),
                                     orthogonal_grid({1, 1, 1}, {1, 2, 3})};
  for (const SweptGrid& grid : grids)
    for (const double gradation : {0.1, 0.3, 1.0})
      for (const unsigned seed : {1u, 2u}) {
        const std::vector<float> before = random_sizes(grid, seed);
        const std::vector<float> after = limited(grid, gradation, before);
        EXPECT_LE(steepest(grid, gradation, after), 1 + 1e-5);
        for (std::size_t at = 0; at < before.size(); ++at) ASSERT_LE(after[at], before[at]);
      }
}

TEST(LimitGradation, IsIdempotent) {
  for (const SweptGrid& grid : {orthogonal_grid({30, 25, 20}, {0.7, 1.1, 2.3}), sheared_grid({20, 20, 20})}) {
    const std::vector<float> once = limited(grid, 0.3, random_sizes(grid, 3));
    const std::vector<float> twice = limited(grid, 0.3, once);
    for (std::size_t at = 0; at < once.size(); ++at) ASSERT_NEAR(twice[at], once[at], 1e-6 * once[at]);
  }
}

/// (h - exact) / (g r) around one fine point: the least, the largest, and the largest beyond 12 voxels.
struct ConeError {
  double least = 1, most = -1, most_far = -1;
};

ConeError cone_error(const SweptGrid& grid) {
  const double gradation = 0.3;
  const Eigen::Vector3d source(grid.size[0] / 2, grid.size[1] / 2, grid.size[2] / 2);
  std::vector<float> h(grid.count(), 1000.F);
  h[grid.offset(grid.size[0] / 2, grid.size[1] / 2, grid.size[2] / 2)] = 0.5F;
  h = limited(grid, gradation, h);
  ConeError error;
  grid.for_each([&](int i, int j, int k, std::size_t at) {
    const Eigen::Vector3d steps = Eigen::Vector3d(i, j, k) - source;
    const double rise = gradation * (grid.linear * steps).norm();
    if (rise == 0) return;
    const double relative = (h[at] - 0.5 - rise) / rise;
    error.least = std::min(error.least, relative);
    error.most = std::max(error.most, relative);
    if (steps.norm() > 12) error.most_far = std::max(error.most_far, relative);
  });
  return error;
}

TEST(LimitGradation, GivesTheAnalyticConeAroundOneFinePointToTheSchemesError) {
  const Size size{61, 61, 61};
  for (const auto& [spacing, near, far] : {std::tuple{Eigen::Vector3d(1, 1, 1), 0.08, 0.05},
                                           std::tuple{Eigen::Vector3d(1.4, 1.4, 2), 0.10, 0.065},
                                           std::tuple{Eigen::Vector3d(1, 1.5, 3), 0.15, 0.10}}) {
    const ConeError error = cone_error(orthogonal_grid(size, spacing));
    EXPECT_GE(error.least, -1e-5);
    EXPECT_LE(error.most, near) << spacing.transpose();
    EXPECT_LE(error.most_far, far) << spacing.transpose();
  }
  const ConeError sheared = cone_error(sheared_grid(size));
  EXPECT_GE(sheared.least, -1e-5);
  EXPECT_LE(sheared.most, 0.27);
}

TEST(LimitGradation, IsExactForPlanesAlongTheAxes) {
  const SweptGrid grid = orthogonal_grid({12, 10, 40}, {1, 1, 1.7});
  std::vector<float> h(grid.count(), 50.F);
  grid.for_each([&](int, int, int k, std::size_t at) {
    if (k == 0) h[at] = 1;
  });
  h = limited(grid, 0.25, h);
  grid.for_each([&](int, int, int k, std::size_t at) { ASSERT_NEAR(h[at], 1 + 0.25 * 1.7 * k, 1e-4); });
}

TEST(LimitGradation, LeavesInfinityWhereNothingIsAskedFor) {
  const SweptGrid grid = orthogonal_grid({6, 5, 4}, {1, 1, 1});
  for (const float h :
       limited(grid, 0.3, std::vector<float>(grid.count(), std::numeric_limits<float>::infinity())))
    EXPECT_EQ(h, std::numeric_limits<float>::infinity());
}

TEST(LimitGradation, FollowsRoundFrontsInGridsOfOneLayerToo) {
  const SweptGrid grid = orthogonal_grid({33, 33, 1}, {1, 1, 1});
  std::vector<float> h(grid.count(), std::numeric_limits<float>::infinity());
  h[16 + 33 * 16] = 1;
  const std::vector<float> field = limited(grid, 0.3, h);
  // Straight paths to the neighbours alone would be 8 % longer.
  const double rise = field[28 + 33 * 22] - 1.0, exact = 0.3 * std::hypot(12, 6);
  EXPECT_GE(rise, exact * (1 - 1e-5));
  EXPECT_LE(rise, 1.055 * exact);
}

TEST(LimitGradation, StopsWhenCancelled) {
  const SweptGrid grid = orthogonal_grid({6, 5, 4}, {1, 1, 1});
  std::vector<float> h(grid.count(), 1.F);
  RunContext ctx;
  ctx.on_cancelled = [] { return true; };
  EXPECT_FALSE(limit_gradation(grid.size, grid.linear, 0.3, h, ctx));
}

}  // namespace
}  // namespace voxtet
