#include "geometry/topology/label_components.h"

#include <gtest/gtest.h>

#include "support/label_bodies.h"

namespace voxtet {
namespace {

TEST(LabelComponents, AreNumberedByTheirFirstVoxel) {
  // 1 1 0     the lone 1 touches the others by an edge only
  // 0 2 1
  const std::array<int, 3> size{3, 2, 1};
  std::vector<std::uint32_t> sizes;
  EXPECT_EQ(label_components(size, {1, 1, 0, 0, 2, 1}, sizes),
            (std::vector<std::uint32_t>{0, 0, 1, 2, 3, 4}));
  EXPECT_EQ(sizes, (std::vector<std::uint32_t>{2, 1, 1, 1, 1}));
  EXPECT_EQ(count_components(size, {1, 1, 0, 0, 2, 1})[1], 2U);
}

TEST(LabelComponents, FollowATorusAround) {
  const LabelVolume volume = test::make_volume(
      21, 21, 9, [](int i, int j, int k) { return test::in_torus(i - 10, j - 10, k - 4, 6, 2.4); });
  const std::vector<std::uint32_t> counts = count_components(volume.size, volume.labels);
  EXPECT_EQ(counts[1], 1U);
  EXPECT_EQ(counts[0], 0U);
}

TEST(NeighbourByArea, TakesTheLowerOfEquals) {
  EXPECT_EQ(neighbour_by_area({3, 1, 1}, {2, 5, 1}, {1}, {1, 1, 1}), 1);
  EXPECT_EQ(neighbour_by_area({3, 1, 1}, {5, 5, 5}, {1}, {1, 1, 1}), 5);
}

}  // namespace
}  // namespace voxtet
