#include "volume/stack/interpolate_slices.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/digest.h"
#include "geometry/topology/label_components.h"
#include "io/volume/read_volume.h"
#include "support/data.h"
#include "support/label_bodies.h"
#include "support/random_labels.h"
#include "volume/stack/compare_slices.h"

namespace voxtet {
namespace {

using test::make_volume;

LabelVolume with_spacing(LabelVolume volume, double x, double y, double z) {
  volume.index_to_mm.diagonal() = Eigen::Vector4d(x, y, z, 1);
  return volume;
}

LabelVolume thick_heart() {
  return with_spacing(test::heart_volume(40, 36, 8), 1.25, 1.25, 8);
}

LabelVolume large_thick_heart() {
  return with_spacing(test::heart_volume(90, 80, 14), 1.25, 1.25, 8);
}

LabelVolume interpolated(const LabelVolume& volume, double ratio = 2) {
  Result<LabelVolume> out = interpolate_slices(volume, ratio, {});
  EXPECT_TRUE(out.ok());
  return std::move(out).value();
}

/// The volume with index axis d of the result taken from axis order[d], reversed where asked; the affine goes
/// along.
LabelVolume turned(const LabelVolume& volume, const std::array<int, 3>& order,
                   const std::array<bool, 3>& reversed) {
  LabelVolume out;
  Eigen::Matrix4d map = Eigen::Matrix4d::Zero();
  map(3, 3) = 1;
  for (int d = 0; d < 3; ++d) {
    const int from = order[static_cast<std::size_t>(d)];
    out.size[static_cast<std::size_t>(d)] = volume.size[static_cast<std::size_t>(from)];
    const bool back = reversed[static_cast<std::size_t>(d)];
    map(from, d) = back ? -1 : 1;
    if (back) map(from, 3) = volume.size[static_cast<std::size_t>(from)] - 1;
  }
  out.index_to_mm = volume.index_to_mm * map;
  out.labels.resize(volume.labels.size());
  for (int k = 0; k < out.size[2]; ++k)
    for (int j = 0; j < out.size[1]; ++j)
      for (int i = 0; i < out.size[0]; ++i) {
        const Eigen::Vector4d at = map * Eigen::Vector4d(i, j, k, 1);
        out.labels[out.offset(i, j, k)] =
            volume.at(static_cast<int>(at[0]), static_cast<int>(at[1]), static_cast<int>(at[2]));
      }
  return out;
}

/// Voxels of the finer volume at the centres of the coarser one's that have another label.
std::size_t changed_slices(const LabelVolume& coarse, const LabelVolume& fine) {
  std::size_t changed = 0;
  std::array<int, 3> planes{};
  for (std::size_t d = 0; d < 3; ++d) planes[d] = fine.size[d] / coarse.size[d];
  for (int k = 0; k < coarse.size[2]; ++k)
    for (int j = 0; j < coarse.size[1]; ++j)
      for (int i = 0; i < coarse.size[0]; ++i)
        changed += coarse.at(i, j, k) != fine.at(i * planes[0] + planes[0] / 2, j * planes[1] + planes[1] / 2,
                                                 k * planes[2] + planes[2] / 2);
  return changed;
}

double largest_volume_change(const LabelVolume& before, const LabelVolume& after) {
  const std::vector<double> a = test::label_counts(before), b = test::label_counts(after);
  double largest = 0;
  for (std::size_t label = 1; label < a.size(); ++label)
    if (a[label] > 0)
      largest =
          std::max(largest, std::abs(b[label] * after.voxel_mm3() / (a[label] * before.voxel_mm3()) - 1));
  return largest;
}

bool touch(const LabelVolume& volume, Label a, Label b) {
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i)
        for (int d = 0; d < 27 && volume.at(i, j, k) == a; ++d) {
          const int x = d % 3 - 1, y = d / 3 % 3 - 1, z = d / 9 - 1;
          if (std::abs(x) + std::abs(y) + std::abs(z) <= 2 && volume.contains(i + x, j + y, k + z) &&
              volume.at(i + x, j + y, k + z) == b)
            return true;
        }
  return false;
}

TEST(ThickSlices, AreThoseAboveTheRatio) {
  const LabelVolume volume = with_spacing(test::ball_volume(4, 2, 1), 1, 1, 2);
  EXPECT_FALSE(has_thick_slices(volume, 2));
  EXPECT_TRUE(has_thick_slices(volume, 1.9));
  EXPECT_FALSE(has_thick_slices(volume, 0));
}

/// As headers hold it: turned, in single precision.
LabelVolume oblique(LabelVolume volume, double angle) {
  Eigen::Matrix4d turn = Eigen::Matrix4d::Identity();
  turn.topLeftCorner<3, 3>() =
      Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  volume.index_to_mm = (turn * volume.index_to_mm).cast<float>().cast<double>();
  return volume;
}

TEST(ThickSlices, AreTheSameWithAnyObliqueHeader) {
  for (int step = 0; step < 100; ++step) {
    const double angle = 0.03 * step;
    const auto of = [&](double spacing) {
      return oblique(with_spacing(test::ball_volume(4, 2, 1), 1.4, 1.4, spacing), angle);
    };
    EXPECT_FALSE(has_thick_slices(of(2 * 1.4), 2)) << angle;
    EXPECT_TRUE(has_thick_slices(of(2.01 * 1.4), 2)) << angle;
    if (step % 25 != 0) continue;
    EXPECT_EQ(interpolated(of(4 * 1.4)).size[2], 12) << angle;
    EXPECT_EQ(interpolated(of(6 * 1.4)).size[2], 20) << angle;
  }
}

TEST(InterpolateSlices, TakesNoPixelsForThickSlices) {
  const LabelVolume even = with_spacing(test::heart_volume(20, 18, 18), 1.4, 1.4 * (1 + 1e-6), 1.4);
  for (const double ratio : {0.1, 0.5, 1.0}) EXPECT_FALSE(has_thick_slices(even, ratio)) << ratio;
  const LabelVolume slices = with_spacing(test::heart_volume(20, 18, 8), 1.4, 1.4 * (1 + 1e-6), 3.5);
  const LabelVolume out = interpolated(slices, 1);
  EXPECT_EQ(out.size[0], 20);
  EXPECT_EQ(out.size[1], 18);
  EXPECT_GT(out.size[2], 8);
}

TEST(InterpolateSlices, CoversTheSameSpaceWithAnOddNumberOfPlanes) {
  for (const auto& [spacing, planes] : {std::pair{2.1, 3}, {3.0, 3}, {4.0, 3}, {4.5, 5}, {8.0, 7}}) {
    const LabelVolume coarse = with_spacing(test::heart_volume(12, 12, 5), 1, 1, spacing);
    const LabelVolume fine = interpolated(coarse);
    EXPECT_EQ(fine.size, (std::array<int, 3>{12, 12, 5 * planes})) << spacing;
    for (const double end : {0.0, 1.0}) {
      const auto corner = [&](const LabelVolume& v) {
        return v.to_mm(Eigen::Vector3d(end * v.size[0] - 0.5, end * v.size[1] - 0.5, end * v.size[2] - 0.5));
      };
      EXPECT_LT((corner(coarse) - corner(fine)).norm(), 1e-9);
    }
  }
}

TEST(InterpolateSlices, KeepsTheSlicesThemselves) {
  const LabelVolume coarse = thick_heart();
  EXPECT_EQ(changed_slices(coarse, interpolated(coarse)), 0U);
}

TEST(InterpolateSlices, GivesEveryLabelItsVolumeBack) {
  const LabelVolume coarse = large_thick_heart();
  EXPECT_LT(largest_volume_change(coarse, interpolated(coarse)), 0.003);
}

TEST(InterpolateSlices, LeavesWhatAllSlicesAgreeOn) {
  const LabelVolume coarse = with_spacing(
      make_volume(9, 9, 4, [](int i, int j, int) { return i > 2 && j > 3 ? (i > 5 ? 2 : 1) : 0; }), 1, 1, 5);
  const LabelVolume fine = interpolated(coarse);
  for (int k = 0; k < fine.size[2]; ++k)
    for (int j = 0; j < 9; ++j)
      for (int i = 0; i < 9; ++i) EXPECT_EQ(fine.at(i, j, k), coarse.at(i, j, 0));
}

TEST(InterpolateSlices, TurnsAndMirrorsWithItsInput) {
  const LabelVolume coarse = thick_heart(), fine = interpolated(coarse);
  const std::array<std::array<int, 3>, 6> orders{
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  for (const std::array<int, 3>& order : orders)
    for (const int mirror : {0, 1, 2, 4, 7}) {
      const std::array<bool, 3> reversed{(mirror & 1) != 0, (mirror & 2) != 0, (mirror & 4) != 0};
      const LabelVolume expected = turned(fine, order, reversed),
                        found = interpolated(turned(coarse, order, reversed));
      ASSERT_EQ(found.size, expected.size);
      EXPECT_TRUE(found.index_to_mm.isApprox(expected.index_to_mm, 1e-12));
      EXPECT_EQ(found.labels, expected.labels) << order[0] << order[1] << order[2] << " mirror " << mirror;
    }
}

TEST(InterpolateSlices, DoesNotMindAnObliqueAffine) {
  LabelVolume coarse = thick_heart();
  const LabelVolume fine = interpolated(coarse);
  Eigen::Matrix4d oblique = Eigen::Matrix4d::Identity();
  oblique.topLeftCorner<3, 3>() =
      Eigen::AngleAxisd(0.9, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  oblique.topRightCorner<3, 1>() = Eigen::Vector3d(10, -20, 30);
  coarse.index_to_mm = oblique * coarse.index_to_mm;
  const LabelVolume turned_fine = interpolated(coarse);
  std::size_t different = 0;  // ties settled by the rounding of the spacings
  for (std::size_t v = 0; v < fine.labels.size(); ++v) different += turned_fine.labels[v] != fine.labels[v];
  EXPECT_LT(different, fine.labels.size() / 200);
  EXPECT_TRUE(turned_fine.index_to_mm.isApprox(oblique * fine.index_to_mm, 1e-12));
}

TEST(InterpolateSlices, RefinesTwoCoarseAxes) {
  const LabelVolume coarse = with_spacing(test::heart_volume(30, 10, 10), 1, 3, 3);
  const LabelVolume fine = interpolated(coarse);
  EXPECT_EQ(fine.size, (std::array<int, 3>{30, 30, 30}));
  EXPECT_EQ(changed_slices(coarse, fine), 0U);
}

TEST(InterpolateSlices, TakesASingleSlice) {
  const LabelVolume coarse = with_spacing(test::heart_volume(12, 12, 1), 1, 1, 5);
  EXPECT_EQ(interpolated(coarse).size, (std::array<int, 3>{12, 12, 5}));
}

/// A wall two voxels thick between pool (left) and background, that moves by three times that from slice to
/// slice.
TEST(InterpolateSlices, KeepsAThinWallThatMovesFartherThanItIsThick) {
  const LabelVolume coarse = with_spacing(make_volume(50, 20, 6,
                                                      [](int i, int, int k) {
                                                        const int wall = 8 + 6 * k;
                                                        return i < wall ? 2 : (i < wall + 2 ? 1 : 0);
                                                      }),
                                          1, 1, 8);
  const LabelVolume fine = interpolated(coarse);
  EXPECT_FALSE(touch(fine, 2, kBackground));
  EXPECT_EQ(count_components(fine.size, fine.labels)[1], 1U);
  EXPECT_LT(largest_volume_change(coarse, fine), 0.003);
}

/// A pool with a wall around it that ends between two slices.
TEST(InterpolateSlices, ClosesTheWallOverATip) {
  const LabelVolume coarse = with_spacing(make_volume(40, 40, 6,
                                                      [](int i, int j, int k) {
                                                        const double r = std::hypot(i - 20, j - 19);
                                                        if (k > 3) return 0;
                                                        return r < 6 ? 2 : (r < 9 ? 1 : 0);
                                                      }),
                                          1, 1, 8);
  const LabelVolume fine = interpolated(coarse);
  int top = 0;
  for (int k = 0; k < fine.size[2]; ++k)
    if (fine.at(20, 19, k) == 2) top = k;
  EXPECT_EQ(fine.at(20, 19, top + 1), 1);
  EXPECT_FALSE(touch(fine, 2, kBackground));
}

TEST(InterpolateSlices, EndsAWideCutFlat) {
  const LabelVolume coarse = with_spacing(
      make_volume(70, 70, 4, [](int i, int j, int k) { return k < 2 && std::hypot(i - 35, j - 35) < 30; }), 1,
      1, 5);
  const LabelVolume fine = interpolated(coarse);
  for (int k = 0; k < fine.size[2]; ++k) EXPECT_EQ(fine.at(60, 35, k), k < 10 ? 1 : 0) << k;
}

/// Lesions on one slice and on two, in a body that goes through all of them.
TEST(InterpolateSlices, KeepsTheVolumeOfLabelsOnOneSliceAsSlabs) {
  const LabelVolume coarse = with_spacing(make_volume(40, 40, 9,
                                                      [](int i, int j, int k) {
                                                        if (k == 4 && std::hypot(i - 14, j - 20) < 6)
                                                          return 2;
                                                        if (k > 2 && k < 5 && std::hypot(i - 26, j - 20) < 6)
                                                          return 3;
                                                        if (k == 6 && i == 20 && j == 20) return 4;
                                                        return std::hypot(i - 20, j - 20) < 18 ? 1 : 0;
                                                      }),
                                          0.5, 0.5, 5);
  std::vector<std::string> notes;
  RunContext ctx;
  ctx.on_note = [&](const std::string&, const std::string& text) { notes.push_back(text); };
  ctx.on_warning = [](const std::string&, const std::string& text) { ADD_FAILURE() << text; };
  const LabelVolume fine = interpolate_slices(coarse, 2, ctx).value();
  EXPECT_LT(largest_volume_change(coarse, fine), 0.05);
  EXPECT_EQ(changed_slices(coarse, fine), 0U);
  EXPECT_NE(notes.front().find("kept as slabs"), std::string::npos) << notes.front();
}

TEST(InterpolateSlices, PutsNothingBetweenStackedLabels) {
  const LabelVolume coarse = with_spacing(
      make_volume(20, 20, 6,
                  [](int i, int j, int k) { return std::hypot(i - 10, j - 10) < 4 ? (k < 3 ? 1 : 2) : 0; }),
      1, 1, 8);
  const LabelVolume fine = interpolated(coarse);
  for (int k = 0; k < fine.size[2]; ++k) EXPECT_EQ(fine.at(12, 10, k), 2 * k < fine.size[2] ? 1 : 2);
}

TEST(InterpolateSlices, GivesTheSameVoxelsOnEveryPlatform) {
  EXPECT_EQ(digest_of(interpolated(thick_heart())),
            "f5f8b59ef8e0ac6804552e37a1bf54d3eb1de44db1c3b7e502d2cbce1ebd7a25");
}

TEST(InterpolateSlices, SaysWhatItDid) {
  std::vector<std::string> notes, warnings;
  RunContext ctx;
  ctx.on_note = [&](const std::string& stage, const std::string& text) {
    EXPECT_EQ(stage, "volume");
    notes.push_back(text);
  };
  ctx.on_warning = [&](const std::string&, const std::string& text) { warnings.push_back(text); };
  ASSERT_TRUE(interpolate_slices(large_thick_heart(), 2, ctx).ok());
  ASSERT_FALSE(notes.empty());
  EXPECT_NE(notes[0].find("90 x 80 x 14 voxels of 1.25 x 1.25 x 8 mm to 90 x 80 x 98 voxels"),
            std::string::npos)
      << notes[0];
  EXPECT_TRUE(warnings.empty()) << warnings[0];
}

TEST(InterpolateSlices, WarnsOfTunnelsThatItOpens) {
  const auto tube = [](bool open) {
    return with_spacing(make_volume(9, 9, 3,
                                    [open](int i, int j, int) {
                                      const bool rim = i > 0 && j > 0 && i < 8 && j < 8;
                                      const bool bore = i > 2 && i < 6 && j > 2 && j < 6;
                                      return rim && !(open && bore) ? 1 : 0;
                                    }),
                        1, 1, 4);
  };
  std::vector<std::string> warnings;
  RunContext ctx;
  ctx.on_warning = [&](const std::string&, const std::string& text) { warnings.push_back(text); };
  slices::compare_slices(tube(true), tube(false), ctx);
  for (const std::string& text : warnings) EXPECT_EQ(text.find("tunnels"), std::string::npos) << text;
  warnings.clear();
  slices::compare_slices(tube(false), tube(true), ctx);
  ASSERT_FALSE(warnings.empty());
  EXPECT_NE(warnings.back().find("tunnels in them, components and Euler number: label 1 1 to 1 and 1 to 0"),
            std::string::npos)
      << warnings.back();
}

TEST(InterpolateSlices, RefusesToMakeVoxelsWithoutEnd) {
  const LabelVolume volume = with_spacing(test::ball_volume(50, 25, 20), 1e-4, 1, 1);
  const Result<LabelVolume> out = interpolate_slices(volume, 2, {});
  ASSERT_FALSE(out.ok());
  EXPECT_EQ(out.error().code, ErrorCode::kOutOfMemory);
  EXPECT_NE(out.error().message.find("volume.slice_ratio"), std::string::npos);
}

TEST(InterpolateSlices, CanBeCancelled) {
  RunContext ctx;
  ctx.on_cancelled = [] { return true; };
  const Result<LabelVolume> out = interpolate_slices(thick_heart(), 2, ctx);
  ASSERT_FALSE(out.ok());
  EXPECT_EQ(out.error().code, ErrorCode::kCancelled);
}

TEST(InterpolateSlices, KeepsRandomSlicesWhateverTheyHold) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const LabelVolume coarse =
        with_spacing(test::random_volume(6, 1 + static_cast<int>(seed % 5), seed), 1, 1.5, 4);
    EXPECT_EQ(changed_slices(coarse, interpolated(coarse)), 0U) << seed;
  }
}

class SharedThickVolume : public testing::TestWithParam<const char*> {};

TEST_P(SharedThickVolume, KeepsSlicesAndVolumes) {
  const std::string file = test::shared_data(GetParam());
  if (file.empty()) GTEST_SKIP() << GetParam() << " is absent";
  const LabelVolume coarse = read_volume_file(file).value();
  RunContext ctx;
  ctx.on_note = [&](const std::string&, const std::string& text) { std::printf("  %s\n", text.c_str()); };
  ctx.on_warning = [&](const std::string&, const std::string& text) {
    std::printf("  warning: %s\n", text.c_str());
  };
  const auto start = std::chrono::steady_clock::now();
  const Result<LabelVolume> fine = interpolate_slices(coarse, 2, ctx);
  std::printf("  %.3f s\n", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  ASSERT_TRUE(fine.ok());
  EXPECT_EQ(changed_slices(coarse, *fine), 0U);
  EXPECT_LT(largest_volume_change(coarse, *fine), 0.01);
}

INSTANTIATE_TEST_SUITE_P(Files, SharedThickVolume,
                         testing::Values("biv_ed_oblique_sax.nii.gz", "biv_es_oblique_sax.nii.gz",
                                         "prostate_phantom.nrrd"));

}  // namespace
}  // namespace voxtet
