#include "types/grid.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/test_random.h"

namespace voxtet {
namespace {

/// Oblique, sheared, and mirrored for every other seed.
SearchableGrid random_grid(unsigned seed) {
  test::TestRandom random(seed);
  SearchableGrid grid;
  for (int& n : grid.size) n = 1 + random.below(6);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      grid.index_to_mm(row, column) = random.below(2000) / 1000.0 - 1;
  grid.index_to_mm.topLeftCorner<3, 3>().diagonal().array() += 4;
  if (seed % 2) grid.index_to_mm.col(0) *= -1;
  grid.invert();
  return grid;
}

TEST(Grid, VisitsEveryPointOnceInTheOrderOfItsOffsets) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const Grid grid = random_grid(seed);
    std::size_t next = 0;
    grid.visit([&](int i, int j, int k, std::size_t at) {
      EXPECT_EQ(at, next++);
      EXPECT_EQ(at, grid.offset(i, j, k));
      EXPECT_EQ(at, static_cast<std::size_t>(i) * grid.strides()[0] +
                        static_cast<std::size_t>(j) * grid.strides()[1] +
                        static_cast<std::size_t>(k) * grid.strides()[2]);
    });
    EXPECT_EQ(next, grid.voxel_count());
  }
}

TEST(Grid, HasItsBorderWhereANeighbourIsMissing) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const Grid grid = random_grid(seed);
    grid.visit([&](int i, int j, int k, std::size_t) {
      const bool inner = grid.contains(i - 1, j, k) && grid.contains(i + 1, j, k) &&
                         grid.contains(i, j - 1, k) && grid.contains(i, j + 1, k) &&
                         grid.contains(i, j, k - 1) && grid.contains(i, j, k + 1);
      EXPECT_EQ(grid.on_border(i, j, k), !inner) << i << ' ' << j << ' ' << k;
    });
  }
}

TEST(Grid, FindsThePointsThatItPlaces) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const SearchableGrid grid = random_grid(seed);
    grid.visit([&](int i, int j, int k, std::size_t) {
      EXPECT_LT((grid.to_index(grid.to_mm(i, j, k)) - Eigen::Vector3d(i, j, k)).norm(), 1e-12);
    });
    const Eigen::Vector3d step = grid.to_mm(0, 1, 0) - grid.to_mm(0, 0, 0);
    EXPECT_NEAR(step.norm(), grid.spacing_mm()[1], 1e-12);
    const Eigen::Vector3d x = grid.to_mm(1, 0, 0) - grid.to_mm(0, 0, 0),
                          z = grid.to_mm(0, 0, 1) - grid.to_mm(0, 0, 0);
    EXPECT_NEAR(std::abs(x.cross(step).dot(z)), grid.voxel_mm3(), 1e-9);
  }
}

}  // namespace
}  // namespace voxtet
