#include "geometry/search/spread_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace voxtet {
namespace {

std::vector<std::vector<std::uint32_t>> lists_of(const Buckets<std::uint32_t>& groups) {
  std::vector<std::vector<std::uint32_t>> out;
  for (std::size_t g = 0; g < groups.size(); ++g) out.emplace_back(groups.at(g).begin(), groups.at(g).end());
  return out;
}

TEST(InGroups, KeepsTheOrderInEachGroup) {
  const Buckets<std::uint32_t> groups = in_groups(std::vector<std::uint32_t>{1, 0, 3, 1, 0});
  EXPECT_EQ(lists_of(groups), (std::vector<std::vector<std::uint32_t>>{{1, 4}, {0, 3}, {}, {2}}));
  EXPECT_EQ(in_groups({}).size(), 0U);
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
    const Buckets<std::uint32_t> groups = spread_order(zones);
    std::vector<std::size_t> group(zones.size(), groups.size());
    for (std::size_t g = 0; g < groups.size(); ++g)
      for (const std::uint32_t i : groups.at(g)) group[i] = g;
    EXPECT_LT(*std::max_element(group.begin(), group.end()), groups.size()) << "all are in one";
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
  const Buckets<std::uint32_t> groups = spread_order(zones);
  ASSERT_EQ(groups.size(), 3U);
  for (std::size_t g = 0; g < 3; ++g) EXPECT_EQ(groups.at(g).size(), 8U) << g;
  EXPECT_EQ(spread_order({}).size(), 0U);
}

}  // namespace
}  // namespace voxtet
