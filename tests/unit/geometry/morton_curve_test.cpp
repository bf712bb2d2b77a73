#include "geometry/search/morton_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "support/test_random.h"

namespace voxtet {
namespace {

TEST(MortonCurve, GoesThroughTheCornersOfACubeInTheOrderOfTheirBits) {
  std::vector<Eigen::Vector3d> corners;
  for (int c = 0; c < 8; ++c) corners.emplace_back(c & 1, c >> 1 & 1, c >> 2 & 1);
  const MortonCurve curve(corners);
  for (std::size_t c = 1; c < 8; ++c) EXPECT_LT(curve.place(corners[c - 1]), curve.place(corners[c])) << c;
  EXPECT_EQ(curve.place(corners[0]), 0U);
  EXPECT_EQ(curve.place(corners[7]), (1U << 30) - 1);
}

TEST(MortonCurve, GivesOnePointAndPointsInOnePlaceTheFirstPlace) {
  const std::vector<Eigen::Vector3d> same(3, Eigen::Vector3d(1, -2, 3));
  EXPECT_EQ(MortonCurve(same).place(same[2]), 0U);
}

TEST(OrderOfPlaces, IsThatOfAStableSort) {
  test::TestRandom random(7);
  std::vector<std::uint32_t> places;
  for (int i = 0; i < 3000; ++i)
    places.push_back(static_cast<std::uint32_t>(random.below(i % 3 == 0 ? 5 : 1 << 30)));
  std::vector<std::uint32_t> sorted(places.size());
  std::iota(sorted.begin(), sorted.end(), 0U);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return places[a] < places[b]; });
  EXPECT_EQ(order_of_places(places), sorted);
  EXPECT_TRUE(order_of_places({}).empty());
}

}  // namespace
}  // namespace voxtet
