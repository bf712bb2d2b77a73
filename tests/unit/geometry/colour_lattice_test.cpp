#include "geometry/search/colour_lattice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/test_random.h"

namespace voxtet {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Points random_points(std::size_t count) {
  test::TestRandom random(11);
  const auto between = [&random](int low, int high) {
    return low + random.below(1000) * (high - low) / 1000.0;
  };
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = between(-7, 20), y = between(3, 9);
    points.emplace_back(x, y, between(0, 4));
  }
  return points;
}

TEST(ColourLattice, HoldsEveryItemOnceInsideOfItsZone) {
  const Points points = random_points(2000);
  const ColourLattice lattice(points, 1.7);
  std::vector<std::uint32_t> items;
  for (std::size_t colour = 0; colour < ColourLattice::kColours; ++colour)
    for (const ColourLattice::Cube& cube : lattice.cubes_of(colour)) {
      EXPECT_FALSE(cube.items.empty());
      EXPECT_TRUE(std::is_sorted(cube.items.begin(), cube.items.end()));
      for (const std::uint32_t i : cube.items)
        EXPECT_TRUE(cube.zone.holds(points[i] - Eigen::Vector3d::Constant(0.84)) &&
                    cube.zone.holds(points[i] + Eigen::Vector3d::Constant(0.84)));
      items.insert(items.end(), cube.items.begin(), cube.items.end());
    }
  std::sort(items.begin(), items.end());
  ASSERT_EQ(items.size(), points.size());
  for (std::uint32_t i = 0; i < items.size(); ++i) EXPECT_EQ(items[i], i);
}

TEST(ColourLattice, NoTwoZonesOfAColourMeet) {
  const ColourLattice lattice(random_points(2000), 1.3);
  ASSERT_GT(lattice.size(), 100U);
  for (std::size_t colour = 0; colour < ColourLattice::kColours; ++colour)
    for (const ColourLattice::Cube& a : lattice.cubes_of(colour))
      for (const ColourLattice::Cube& b : lattice.cubes_of(colour)) {
        if (&a == &b) continue;
        const bool apart = (a.zone.high.array() <= b.zone.low.array()).any() ||
                           (b.zone.high.array() <= a.zone.low.array()).any();
        EXPECT_TRUE(apart);
      }
}

TEST(ColourLattice, HasFewCubesWhereTheSideIsTiny) {
  EXPECT_LE(ColourLattice(random_points(50), 1e-9).size(), 50U);
  EXPECT_EQ(ColourLattice(Points(3, {1, 2, 3}), 1).size(), 1U);
  EXPECT_EQ(ColourLattice(Points{}, 1).size(), 0U);
}

/// Every item adds what is near it to its own value: the result depends on the order.
std::vector<double> sums_near(int threads) {
  const Points points = random_points(3000);
  const ColourLattice lattice(points, 2);
  std::vector<double> values(points.size(), 1);
  std::vector<std::size_t> order(lattice.size());
  std::size_t begun = 0, ended = 0;
  const auto before = [&](std::span<const ColourLattice::Cube> cubes, std::size_t first) {
    EXPECT_EQ(first, begun);
    begun += cubes.size();
  };
  const auto visit = [&](const ColourLattice::Cube& cube, std::size_t number, std::vector<double>& near) {
    order[number] = cube.items.front();
    for (const std::uint32_t i : cube.items) {
      near.clear();
      for (std::size_t j = 0; j < points.size(); ++j)
        if ((points[i] - points[j]).norm() < 0.9) near.push_back(values[j]);
      for (const double value : near) values[i] += value / 100;
    }
  };
  const auto after = [&](std::span<const ColourLattice::Cube> cubes, std::size_t first) {
    EXPECT_EQ(first, ended);
    ended += cubes.size();
    EXPECT_EQ(ended, begun);
  };
  for_colours(
      threads, lattice, before, [] { return std::vector<double>(); }, visit, after);
  EXPECT_EQ(ended, lattice.size());
  std::sort(order.begin(), order.end());
  EXPECT_EQ(std::adjacent_find(order.begin(), order.end()), order.end());
  return values;
}

TEST(ForColours, GivesTheSameForAnyNumberOfThreads) {
  const std::vector<double> one = sums_near(1);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(sums_near(threads), one) << threads;
}

}  // namespace
}  // namespace voxtet
