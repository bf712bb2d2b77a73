#include "geometry/search/spread_order.h"

#include <gtest/gtest.h>

#include <random>

namespace voxtet {
namespace {

TEST(InGroups, KeepsTheOrderInEachGroup) {
  const SpreadOrder order = in_groups(std::vector<std::size_t>{1, 0, 3, 1, 0});
  EXPECT_EQ(order.items, (std::vector<std::uint32_t>{1, 4, 0, 3, 2}));
  EXPECT_EQ(order.ends, (std::vector<std::size_t>{2, 4, 4, 5}));
  EXPECT_TRUE(order.group(2).empty());
  EXPECT_EQ(order.group(3).front(), 2U);
}

TEST(SpreadOrder, PartsZonesThatMeetAndKeepsTheirOrder) {
  std::mt19937 random(3);
  const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
  for (const double largest_mm : {0.3, 1.0, 40.0}) {
    std::vector<Eigen::AlignedBox3d> zones;
    for (int i = 0; i < 600; ++i) {
      const Eigen::Vector3d low(20 * unit() - 10, 20 * unit() - 10, 20 * unit() - 10);
      const double size_mm = i % 100 == 0 ? largest_mm : 0.3;
      zones.emplace_back(low, low + size_mm * Eigen::Vector3d(unit(), unit(), unit()));
    }
    const SpreadOrder order = spread_order(zones);
    ASSERT_EQ(order.items.size(), zones.size());
    ASSERT_EQ(order.ends.back(), zones.size());
    std::vector<std::size_t> group(zones.size(), zones.size());
    for (std::size_t g = 0; g < order.ends.size(); ++g)
      for (const std::uint32_t i : order.group(g)) group[i] = g;
    for (std::size_t i = 0; i < zones.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (zones[i].intersects(zones[j])) {
          EXPECT_LT(group[j], group[i]) << j << ' ' << i;
        }
  }
}

TEST(SpreadOrder, PutsWhatIsApartTogether) {
  std::vector<Eigen::AlignedBox3d> zones;
  for (int i = 0; i < 8; ++i)
    for (int again = 0; again < 3; ++again)
      zones.emplace_back(Eigen::Vector3d(9.0 * i, 0, 0), Eigen::Vector3d(9.0 * i + 0.5, 0.5, 0.5));
  EXPECT_EQ(spread_order(zones).ends, (std::vector<std::size_t>{8, 16, 24}));
  EXPECT_TRUE(spread_order({}).ends.empty());
}

}  // namespace
}  // namespace voxtet
