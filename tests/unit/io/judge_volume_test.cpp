// Grey images are told from labels, whatever the labels' number and shape.
#include "io/volume/voxels/judge_volume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "unit/io/shared_volumes.h"

namespace voxtet::test {
namespace {

template <class LabelAt>
LabelVolume volume_of(std::array<int, 3> size, LabelAt label_at) {
  LabelVolume volume;
  volume.size = size;
  volume.visit([&](int i, int j, int k, std::size_t) {
    volume.labels.push_back(static_cast<Label>(label_at(Eigen::Vector3d(i, j, k))));
  });
  return volume;
}

/// Distance from the middle of 48 voxels a side.
double radius(const Eigen::Vector3d& p) {
  return (p - Eigen::Vector3d::Constant(23.5)).norm();
}

/// Inside a ball the number of the nearest of some seeds, outside the background.
LabelVolume atlas(int labels, std::array<int, 3> size, const Eigen::Vector3d& spacing, unsigned seed) {
  std::mt19937 random(seed);
  const auto unit = [&] { return static_cast<double>(random() % 10000) / 10000; };
  const Eigen::Vector3d span = spacing.cwiseProduct(Eigen::Vector3d(size[0], size[1], size[2]));
  std::vector<Eigen::Vector3d> seeds;
  for (int n = 0; n < labels; ++n) seeds.emplace_back(unit() * span[0], unit() * span[1], unit() * span[2]);
  return volume_of(size, [&](const Eigen::Vector3d& index) {
    const Eigen::Vector3d p = index.cwiseProduct(spacing);
    if ((p - span / 2).cwiseQuotient(span).norm() > 0.48) return 0;
    int best = 0;
    for (int n = 1; n < labels; ++n)
      if ((p - seeds[static_cast<std::size_t>(n)]).squaredNorm() <
          (p - seeds[static_cast<std::size_t>(best)]).squaredNorm())
        best = n;
    return best + 1;
  });
}

TEST(JudgeVolume, AnAtlasOfManyLabelsIsNoImage) {
  EXPECT_EQ(count_values_of_image(atlas(62, {48, 48, 48}, {1, 1, 1}, 1)), 0U);
  EXPECT_EQ(count_values_of_image(atlas(366, {60, 60, 60}, {1, 1, 1}, 2)), 0U);
  EXPECT_EQ(count_values_of_image(atlas(366, {90, 90, 12}, {1, 1, 6}, 3)), 0U);
}

TEST(JudgeVolume, SmallAndLayeredBodiesAreNoImage) {
  // Cells of one to a few voxels, each with a number of its own, apart from each other.
  std::mt19937 random(4);
  int next = 0;
  EXPECT_EQ(count_values_of_image(volume_of({48, 48, 48},
                                            [&](const Eigen::Vector3d& p) {
                                              const bool free = static_cast<int>(p[0]) % 2 == 0 &&
                                                                static_cast<int>(p[1]) % 2 == 0 &&
                                                                static_cast<int>(p[2]) % 2 == 0;
                                              return free && random() % 4 == 0 ? ++next : 0;
                                            })),
            0U);
  EXPECT_GT(next, 1000);
  // Shells from outside to inside, of one voxel each, and slabs.
  EXPECT_EQ(count_values_of_image(volume_of(
                {48, 48, 48},
                [](const Eigen::Vector3d& p) { return std::max(0, 23 - static_cast<int>(radius(p))); })),
            0U);
  EXPECT_EQ(count_values_of_image(volume_of(
                {8, 8, 400}, [](const Eigen::Vector3d& p) { return 1 + static_cast<int>(p[2]) / 4; })),
            0U);
}

TEST(JudgeVolume, GreyImagesAreTold) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 1);
  // Noise on a body, with background around it and without.
  for (const double sigma : {4.0, 20.0, 300.0})
    for (const bool masked : {false, true}) {
      SCOPED_TRACE(sigma);
      const LabelVolume image = volume_of({48, 48, 48}, [&](const Eigen::Vector3d& p) {
        const double grey = 1000 + (radius(p) < 15 ? 60 : 0) + sigma * noise(random);
        return masked && radius(p) > 20 ? 0.0 : std::max(0.0, grey);
      });
      EXPECT_GT(count_values_of_image(image), 30U);
    }
  // A smooth image without any noise.
  EXPECT_GT(count_values_of_image(volume_of({48, 48, 48},
                                            [](const Eigen::Vector3d& p) {
                                              return 128 + 100 * std::sin(p[0] / 9) * std::cos(p[1] / 11) *
                                                               std::sin(p[2] / 7);
                                            })),
            100U);
}

TEST(JudgeVolume, RealLabelsAreNoImages) {
  if (shared_data(kSharedVolumes[0]).empty()) GTEST_SKIP() << "the shared data folder is absent";
  for (const char* name : kSharedVolumes) {
    ReadRemarks remarks;
    const Result<LabelVolume> volume = read_volume_file(shared_data(name), {}, &remarks);
    ASSERT_TRUE(volume) << volume.error().message;
    EXPECT_EQ(count_values_of_image(*volume), 0U) << name;
    EXPECT_TRUE(remarks.warnings.empty()) << remarks.warnings[0];
  }
}

}  // namespace
}  // namespace voxtet::test
