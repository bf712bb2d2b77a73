#include "remesh/balance_volumes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "remesh/label_field.h"

namespace voxtet::remesh {
namespace {

/// A shell of label 1 two voxels thick, a ball of label 2 inside it, a rod of label 3 beside them.
LabelGrid thin_bodies() {
  LabelGrid grid;
  grid.size = {40, 28, 28};
  grid.labels.assign(grid.voxel_count(), kBackground);
  std::size_t voxel = 0;
  for (int k = 0; k < 28; ++k)
    for (int j = 0; j < 28; ++j)
      for (int i = 0; i < 40; ++i, ++voxel) {
        const double r =
            std::sqrt((i - 13.3) * (i - 13.3) + (j - 13.6) * (j - 13.6) + (k - 13.8) * (k - 13.8));
        const double rod = std::sqrt((i - 32.2) * (i - 32.2) + (j - 13.4) * (j - 13.4));
        if (r < 4) grid.labels[voxel] = 2;
        if (r > 8 && r < 10) grid.labels[voxel] = 1;
        if (rod < 2.3 && k > 3 && k < 24) grid.labels[voxel] = 3;
      }
  return grid;
}

/// Voxels' worth of each label where it wins, by 4^3 samples a cell.
std::array<double, 4> sampled_volumes(const LabelGrid& grid, const VoxelWeights& weights) {
  std::vector<std::array<double, 4>> dense(grid.voxel_count());
  for (std::size_t v = 0; v < dense.size(); ++v) {
    if (weights.offsets[v] == weights.offsets[v + 1]) dense[v][grid.labels[v]] = 1 << 30;
    for (std::uint32_t e = weights.offsets[v]; e < weights.offsets[v + 1]; ++e)
      dense[v][weights.labels[e]] = weights.weights[e];
  }
  const std::size_t sx = 40, sxy = 40 * 28;
  std::array<double, 4> volumes{};
  const auto sample = [&](std::size_t v, double x, double y, double z) {
    std::array<double, 4> value{};
    for (std::size_t c = 0; c < 8; ++c) {
      const double w = (c & 1 ? x : 1 - x) * (c & 2 ? y : 1 - y) * (c & 4 ? z : 1 - z);
      for (std::size_t l = 0; l < 4; ++l)
        value[l] += w * dense[v + (c & 1) + sx * ((c >> 1) & 1) + sxy * (c >> 2)][l];
    }
    volumes[static_cast<std::size_t>(std::max_element(value.begin(), value.end()) - value.begin())] +=
        1.0 / 64;
  };
  for (std::size_t k = 0; k + 1 < 28; ++k)
    for (std::size_t j = 0; j + 1 < 28; ++j)
      for (std::size_t i = 0; i + 1 < 40; ++i)
        for (int s = 0; s < 64; ++s)
          sample(i + sx * j + sxy * k, (s % 4 + 0.5) / 4, (s / 4 % 4 + 0.5) / 4, (s / 16 + 0.5) / 4);
  return volumes;
}

TEST(BalanceVolumes, GivesBackMostOfWhatSmoothingTakesFromThinAndSmallLabels) {
  const LabelGrid grid = thin_bodies();
  std::array<double, 4> voxels{};
  for (const Label label : grid.labels) voxels[label] += 1;
  const HalfKernel kernel = gaussian_kernel(0.7);
  VoxelWeights weights = smooth_indicators(grid, {kernel, kernel, kernel});
  const std::array<double, 4> before = sampled_volumes(grid, weights);
  balance_volumes(grid, weights);
  const std::array<double, 4> after = sampled_volumes(grid, weights);
  for (const Label label : {1, 2, 3}) {
    const double lost = std::abs(before[label] / voxels[label] - 1),
                 left = std::abs(after[label] / voxels[label] - 1);
    EXPECT_GT(lost, 0.02) << label << ": a body that loses nothing shows nothing";
    EXPECT_LT(left, lost / 4) << label << ": " << lost << " before";
    RecordProperty("error_before_" + std::to_string(label), std::to_string(lost));
    RecordProperty("error_after_" + std::to_string(label), std::to_string(left));
  }
}

TEST(BalanceVolumes, MovesTheFacesOfASlabByLessThanATenthOfAVoxelForItsRim) {
  LabelVolume volume;
  volume.size = {60, 60, 20};
  volume.labels.assign(volume.voxel_count(), kBackground);
  for (int k = 6; k < 14; ++k)
    for (int j = 0; j < 60; ++j)
      for (int i = 0; i < 60; ++i) volume.labels[volume.offset(i, j, k)] = 1;
  const LabelField field(volume, 0.7);
  const Eigen::Vector3d middle(30, 30, 5.5 + LabelField::kPad);
  EXPECT_EQ(field.at_index(middle + Eigen::Vector3d(0, 0, 0.1)), 1);
  EXPECT_EQ(field.at_index(middle - Eigen::Vector3d(0, 0, 0.1)), kBackground);
}

}  // namespace
}  // namespace voxtet::remesh
