// Interpolated slices against volumes that were whole before.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "geometry/topology/label_components.h"
#include "io/bytes/files.h"
#include "io/volume/read_volume.h"
#include "support/data.h"
#include "support/shifted_slices.h"
#include "volume/stack/align_slices.h"
#include "volume/stack/interpolate_slices.h"

namespace voxtet {
namespace {

constexpr int kEvery = 8;

/// `fine` at the voxel centres of `full`, both along the same axes; the outermost voxel beyond the grid.
LabelVolume resampled(const LabelVolume& fine, const LabelVolume& full) {
  LabelVolume out = full;
  const Eigen::Matrix3d to_index = fine.linear().inverse();
  for (int k = 0; k < full.size[2]; ++k)
    for (int j = 0; j < full.size[1]; ++j)
      for (int i = 0; i < full.size[0]; ++i) {
        const Eigen::Vector3d p = to_index * (full.to_mm({double(i), double(j), double(k)}) - fine.origin());
        std::array<int, 3> at{};
        for (int d = 0; d < 3; ++d)
          at[static_cast<std::size_t>(d)] =
              std::clamp(static_cast<int>(std::lround(p[d])), 0, fine.size[static_cast<std::size_t>(d)] - 1);
        out.labels[out.offset(i, j, k)] = fine.at(at[0], at[1], at[2]);
      }
  return out;
}

double dice(const LabelVolume& a, const LabelVolume& b, Label label) {
  double both = 0, sum = 0;
  for (std::size_t v = 0; v < a.labels.size(); ++v) {
    both += a.labels[v] == label && b.labels[v] == label;
    sum += (a.labels[v] == label) + (b.labels[v] == label);
  }
  return 2 * both / sum;
}

double volume_mm3(const LabelVolume& volume, Label label) {
  return volume.voxel_mm3() *
         static_cast<double>(std::count(volume.labels.begin(), volume.labels.end(), label));
}

/// Places (mm) where two labels touch by a face or an edge of voxels.
std::vector<Eigen::Vector3d> contacts(const LabelVolume& volume, Label a, Label b) {
  std::vector<Eigen::Vector3d> out;
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i) {
        if (volume.at(i, j, k) != a) continue;
        bool touches = false;
        for (int d = 0; d < 27; ++d) {
          const int x = d % 3 - 1, y = d / 3 % 3 - 1, z = d / 9 - 1;
          if (std::abs(x) + std::abs(y) + std::abs(z) > 2 || !volume.contains(i + x, j + y, k + z)) continue;
          touches = touches || volume.at(i + x, j + y, k + z) == b;
        }
        if (touches) out.push_back(volume.to_mm({double(i), double(j), double(k)}));
      }
  return out;
}

/// How many of `found` are farther than `far_mm` from all of `known`.
std::size_t beyond(const std::vector<Eigen::Vector3d>& found, const std::vector<Eigen::Vector3d>& known,
                   double far_mm) {
  return static_cast<std::size_t>(std::count_if(found.begin(), found.end(), [&](const Eigen::Vector3d& p) {
    return std::none_of(known.begin(), known.end(),
                        [&](const Eigen::Vector3d& q) { return (p - q).squaredNorm() <= far_mm * far_mm; });
  }));
}

struct Outcome {
  LabelVolume full, coarse, fine, at_full;
};

Outcome thin_out(const std::string& file, int axis, int first) {
  Outcome out;
  out.full = read_volume_file(file).value();
  out.coarse = test::keep_every(out.full, axis, kEvery, first);
  RunContext ctx;
  out.fine = interpolate_slices(out.coarse, 2, ctx).value();
  out.at_full = resampled(out.fine, out.full);
  return out;
}

class EveryEighthSlice : public testing::TestWithParam<int> {};

TEST_P(EveryEighthSlice, KeepsTheVentricularWalls) {
  const std::string file = test::shared_data("biv_mean_1mm.nii.gz");
  if (file.empty()) GTEST_SKIP() << "biv_mean_1mm.nii.gz is absent";
  const int axis = GetParam();
  const Outcome out = thin_out(file, axis, 0);
  std::printf("axis %d: Dice", axis);
  for (const Label label : {1, 2, 3, 4}) std::printf(" %.4f", dice(out.full, out.at_full, label));
  std::printf("; volume against slices %%");
  for (const Label label : {1, 2, 3, 4}) {
    const double change = volume_mm3(out.fine, label) / volume_mm3(out.coarse, label) - 1;
    std::printf(" %+.2f", 100 * change);
    EXPECT_LE(std::abs(change), 0.003) << "label " << label;
  }
  const std::vector<std::uint32_t> parts = count_components(out.fine.size, out.fine.labels);
  std::printf("; components %u %u %u %u;", parts[1], parts[2], parts[3], parts[4]);
  for (const Label pool : {3, 4}) {
    const auto known = contacts(out.full, pool, kBackground), found = contacts(out.fine, pool, kBackground);
    std::printf(" pool %d: %zu touch background, beyond 8 mm of the base %zu;", pool, found.size(),
                beyond(found, known, kEvery));
    if (axis == 2) {
      EXPECT_EQ(beyond(found, known, kEvery), 0U) << "wall perforated at pool " << pool;
    }
  }
  std::printf("\n");
  EXPECT_GE(dice(out.full, out.at_full, 1), 0.92);
  EXPECT_GE(dice(out.full, out.at_full, 2), 0.80);
}

/// Shifts that lean the whole stack cannot be told from a heart that leans, and are left out of those made.
TEST(ShiftedSlices, KeepTheVentricularWallsOnceAligned) {
  const std::string file = test::shared_data("biv_mean_1mm.nii.gz");
  if (file.empty()) GTEST_SKIP() << "biv_mean_1mm.nii.gz is absent";
  const Outcome straight = thin_out(file, 2, 0);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    test::Moves shifts = test::random_moves(straight.coarse, seed, 3);
    while (!test::has_labels(straight.coarse, static_cast<int>(shifts.size()) - 1)) shifts.pop_back();
    test::remove_lean(shifts);
    shifts.resize(static_cast<std::size_t>(straight.coarse.size[2]), Eigen::Vector2d::Zero());
    const auto shifted = std::make_shared<const LabelVolume>(test::shifted(straight.coarse, shifts));
    AlignParams params;
    params.align_slices = true;
    const AlignedVolume aligned = align_slices(shifted, params, 2, {}).value();
    const LabelVolume fine = interpolate_slices(*aligned.volume, 2, {}).value(),
                      unaligned = interpolate_slices(*shifted, 2, {}).value();
    const LabelVolume at_full = resampled(fine, straight.full), left = resampled(unaligned, straight.full);
    std::printf("seed %d: Dice of walls", static_cast<int>(seed));
    for (const Label label : {1, 2}) {
      const double unshifted = dice(straight.full, straight.at_full, label),
                   found = dice(straight.full, at_full, label);
      std::printf(" %.3f, unshifted %.3f, not aligned %.3f;", found, unshifted,
                  dice(straight.full, left, label));
      const double lost = dice(straight.full, left, label);
      EXPECT_GT(found, (unshifted + lost) / 2) << "label " << label << " seed " << seed;
    }
    std::printf("\n");
    for (const Label pool : {3, 4}) {
      const auto known = contacts(straight.full, pool, kBackground),
                 found = contacts(fine, pool, kBackground);
      EXPECT_EQ(beyond(found, known, 2 * kEvery), 0U) << "slit in the wall of pool " << pool;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AlongEachAxis, EveryEighthSlice, testing::Values(0, 1, 2));

}  // namespace
}  // namespace voxtet
