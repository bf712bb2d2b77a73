#include "geometry/grid/distance_transform.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <limits>
#include <random>

#include "geometry/elements/rotation.h"

namespace voxtet {
namespace {

TEST(DistanceTransform, EqualsTheBruteForceDistanceOnAnisotropicGrids) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 40; ++trial) {
    std::array<int, 3> size{};
    Eigen::Vector3d spacing;
    for (int d = 0; d < 3; ++d) {
      size[d] = 1 + static_cast<int>(random() % 20);
      spacing[d] = 0.3 + 0.01 * static_cast<double>(random() % 300);
    }
    std::vector<std::uint8_t> mask(static_cast<std::size_t>(size[0]) * size[1] * size[2], 0);
    std::vector<Eigen::Vector3d> held;
    const auto at = [&](std::size_t v) {
      const int i = static_cast<int>(v) % size[0], j = static_cast<int>(v) / size[0] % size[1];
      const int k = static_cast<int>(v) / size[0] / size[1];
      return Eigen::Vector3d(i * spacing[0], j * spacing[1], k * spacing[2]);
    };
    for (int n = 0; n <= trial / 2; ++n) mask[random() % mask.size()] = 1;
    for (std::size_t v = 0; v < mask.size(); ++v)
      if (mask[v]) held.push_back(at(v));
    const std::vector<float> distance = distance_to_mask_mm(size, spacing, mask);
    ASSERT_EQ(distance.size(), mask.size());
    for (std::size_t v = 0; v < mask.size(); ++v) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const Eigen::Vector3d& p : held) nearest = std::min(nearest, (p - at(v)).norm());
      ASSERT_NEAR(distance[v], nearest, 1e-6 * (1 + nearest)) << "trial " << trial << ", voxel " << v;
    }
  }
}

TEST(DistanceTransform, IsInfiniteWithoutAMask) {
  const std::vector<std::uint8_t> mask(60, 0);
  for (const float d : distance_to_mask_mm({3, 4, 5}, {1, 1, 1}, mask))
    EXPECT_EQ(d, std::numeric_limits<float>::infinity());
}

TEST(Rotation, TurnsAboutTheFixedAxesInOrderAndIsExactForQuarterTurns) {
  const Eigen::Matrix3d turned = rotation_from_degrees({90, 0, 90});
  EXPECT_EQ(Eigen::Vector3d(turned * Eigen::Vector3d(0, 1, 0)), Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(Eigen::Vector3d(turned * Eigen::Vector3d(1, 0, 0)), Eigen::Vector3d(0, 1, 0));
  const Eigen::Matrix3d any = rotation_from_degrees({17, -40, 123});
  EXPECT_LT((any * any.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-11);
  EXPECT_NEAR(any.determinant(), 1, 1e-11);
}

}  // namespace
}  // namespace voxtet
