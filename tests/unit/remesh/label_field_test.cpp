// The continuous label field under the surface.
#include "remesh/label_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "geometry/label_components.h"
#include "support/label_bodies.h"

namespace voxtet::remesh {
namespace {

using Eigen::Vector3d;

Vector3d index_of(const LabelField& field, std::size_t voxel) {
  const auto sx = static_cast<std::size_t>(field.size()[0]), sy = static_cast<std::size_t>(field.size()[1]);
  return {static_cast<double>(voxel % sx), static_cast<double>(voxel / sx % sy),
          static_cast<double>(voxel / (sx * sy))};
}

TEST(LabelField, AgreesWithItsLabelsAtVoxelCentres) {
  const LabelField field(test::random_volume(14, 4, 3), 0.7);
  std::size_t wrong = 0;
  for (std::size_t v = 0; v < field.centre_labels().size(); ++v) {
    const Vector3d index = index_of(field, v);
    if (index[0] + 1 >= field.size()[0] || index[1] + 1 >= field.size()[1] || index[2] + 1 >= field.size()[2])
      continue;
    wrong += field.at_index(index) != field.centre_labels()[v];
  }
  EXPECT_EQ(wrong, 0U);
}

TEST(LabelField, KeepsTheComponentsOfEveryLabelButSpecks) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const LabelVolume volume = test::heart_volume(30 + static_cast<int>(seed), 28, 26);
    const LabelField field(volume, 0.7);
    const auto components = [](const std::array<int, 3>& size, const std::vector<Label>& labels) {
      std::vector<std::uint32_t> sizes;
      const std::vector<std::uint32_t> ids = label_components(size, labels, sizes);
      std::vector<std::uint32_t> count(5, 0);
      std::vector<bool> seen(sizes.size(), false);
      for (std::size_t v = 0; v < ids.size(); ++v) {
        if (seen[ids[v]] || labels[v] == kBackground) continue;
        seen[ids[v]] = true;
        if (sizes[ids[v]] >= kSpeckVoxels) ++count[labels[v]];
      }
      return count;
    };
    EXPECT_EQ(components(field.size(), field.centre_labels()), components(volume.size, volume.labels))
        << seed;
  }
}

TEST(LabelField, NeverLosesALabel) {
  const LabelVolume volume = test::random_volume(10, 60, 5);
  const LabelField field(volume, 1.0);
  EXPECT_GT(field.ledger().retained_voxels, 0U);
  for (const Label label : volume.labels)
    EXPECT_NE(std::find(field.centre_labels().begin(), field.centre_labels().end(), label),
              field.centre_labels().end());
}

TEST(LabelField, FindsCrossingsWhereTheLabelChanges) {
  LabelVolume volume = test::heart_volume(32, 30, 28);
  volume.index_to_mm.topLeftCorner<3, 3>() << 0, -0.8, 0.1, 0.9, 0.1, 0, 0, 0.2, 1.5;
  volume.index_to_mm.topRightCorner<3, 1>() << 5, -20, 100;
  const LabelField field(volume, 0.7);
  test::TestRandom random(4);
  int found = 0;
  for (int trial = 0; trial < 8000; ++trial) {
    const auto pick = [&] {
      Vector3d index;
      for (int d = 0; d < 3; ++d) index[d] = random.below(100 * (field.size()[d] + 20)) / 100.0 - 10;
      return field.to_mm(index);
    };
    const Vector3d a = pick(), b = pick();
    const Label label_a = field.at(a), label_b = field.at(b);
    if (label_a == label_b) continue;
    Label behind = label_a;
    const Vector3d p = field.crossing(a, label_a, b, label_b, behind);
    EXPECT_NE(behind, label_a);
    const Vector3d step = (b - a).normalized() * 1e-3;
    EXPECT_EQ(field.at(p - step), label_a);
    EXPECT_NE(field.at(p + step), label_a);
    ++found;
  }
  EXPECT_GT(found, 500);
}

TEST(LabelField, IsBackgroundFarAwayAndWhereThereIsNoNumber) {
  const LabelField field(test::ball_volume(8, 3.5, 3), 0.7);
  EXPECT_EQ(field.at({1e300, -1e300, 5}), kBackground);
  EXPECT_EQ(field.at(Vector3d::Constant(std::numeric_limits<double>::quiet_NaN())), kBackground);
  EXPECT_EQ(field.at({3.5, 3.5, 3.5}), 1);
}

TEST(LabelField, SmoothsWithKernelsThatSumToOne) {
  for (const double sigma : {0.0, 0.2, 0.4, 0.7, 1.0, 2.0}) {
    const HalfKernel kernel = gaussian_kernel(sigma);
    int sum = kernel[0];
    for (std::size_t i = 1; i < kernel.size(); ++i) sum += 2 * kernel[i];
    EXPECT_EQ(sum, 1024) << sigma;
    EXPECT_GT(kernel[0], 0);
  }
}

}  // namespace
}  // namespace voxtet::remesh
