#include "volume/clean/remove_specks.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>

#include "support/label_bodies.h"
#include "volume/prepare_volume.h"

namespace voxtet {
namespace {

using test::make_volume;

using Removed = std::map<Label, RemovedPieces>;

/// What is left of a volume, and what was removed of it.
std::pair<LabelVolume, Removed> removed_from(LabelVolume volume, const SpeckLimits& limits) {
  Removed removed = remove_specks(volume, limits);
  return {std::move(volume), std::move(removed)};
}

void expect_removed(const Removed& all, Label label, std::size_t pieces, std::size_t voxels,
                    std::size_t largest) {
  const auto found = all.find(label);
  ASSERT_NE(found, all.end()) << "label " << label;
  EXPECT_EQ(found->second.pieces, pieces) << "label " << label;
  EXPECT_EQ(found->second.voxels, voxels) << "label " << label;
  EXPECT_EQ(found->second.largest, largest) << "label " << label;
}

/// Two halves of labels 1 and 2 with a speck of 3 (2 voxels) in the first, one of 1 (1 voxel) in the second,
/// and a hole (1 voxel) in the first. A block of 3 lies apart.
LabelVolume halves() {
  return make_volume(16, 6, 6, [](int i, int j, int k) {
    if (i >= 12) return i >= 13 ? 3 : 0;
    if (j == 3 && k == 3) {
      if (i == 1 || i == 2) return 3;
      if (i == 4) return 0;
      if (i == 9) return 1;
    }
    return i < 6 ? 1 : 2;
  });
}

TEST(RemoveSpecks, DoesNothingUnlessAsked) {
  const auto [left, removed] = removed_from(halves(), {});
  EXPECT_EQ(left.labels, halves().labels);
  EXPECT_TRUE(removed.empty());
}

TEST(RemoveSpecks, GivesSpecksAndHolesToTheirSurroundingsAndReportsThem) {
  const auto [left, removed] = removed_from(halves(), {3, 2});
  EXPECT_EQ(left.at(1, 3, 3), 1);
  EXPECT_EQ(left.at(4, 3, 3), 1);
  EXPECT_EQ(left.at(9, 3, 3), 2);
  EXPECT_EQ(removed.size(), 3U);
  expect_removed(removed, kBackground, 1, 1, 1);
  expect_removed(removed, 1, 1, 1, 1);
  expect_removed(removed, 3, 1, 2, 2);
}

TEST(RemoveSpecks, LeavesNothingOfSpecksInsideOfSpecks) {
  // One voxel of 3 inside 26 of 2, and two specks side by side; beyond a gap their labels have larger pieces.
  const LabelVolume volume = make_volume(28, 9, 9, [](int i, int j, int k) {
    if (i == 14) return 0;
    if (i > 14) return 2 + (i - 15) / 4;
    if (i == 3 && j == 4 && k == 4) return 3;
    if (i >= 2 && i <= 4 && j >= 3 && j <= 5 && k >= 3 && k <= 5) return 2;
    if (j == 4 && k == 4 && (i == 9 || i == 10)) return i == 9 ? 4 : 5;
    return 1;
  });
  const LabelVolume clean = removed_from(volume, {30, 0}).first;
  for (int i = 0; i < 14; ++i) EXPECT_EQ(clean.at(i, 4, 4), 1) << i;
  const LabelVolume out = removed_from(volume, {10, 0}).first;
  EXPECT_EQ(out.at(3, 4, 4), 2);
  EXPECT_EQ(out.at(2, 4, 4), 2);
}

TEST(RemoveSpecks, KeepsTheLargestPieceOfALabel) {
  const LabelVolume volume = make_volume(12, 5, 5, [](int i, int j, int k) {
    if (j == 2 && k == 2) return i == 2 || i == 5 || i == 6 || i == 9 ? 2 : 1;
    return 1;
  });
  const auto [left, removed] = removed_from(volume, {27, 0});
  EXPECT_EQ(left.at(2, 2, 2), 1);
  EXPECT_EQ(left.at(5, 2, 2), 2);
  EXPECT_EQ(left.at(6, 2, 2), 2);
  expect_removed(removed, 2, 2, 2, 1);
}

TEST(RemoveSpecks, KeepsWhatIsLargeEnough) {
  const LabelVolume out = removed_from(halves(), {2, 0}).first;
  EXPECT_EQ(out.at(1, 3, 3), 3);
  EXPECT_EQ(out.at(4, 3, 3), 0);
  EXPECT_EQ(out.at(9, 3, 3), 2);
}

TEST(RemoveSpecks, KeepsBackgroundThatReachesTheBorder) {
  const LabelVolume volume =
      make_volume(5, 5, 5, [](int i, int j, int k) { return i == 2 && j == 2 && k == 0 ? 0 : 1; });
  EXPECT_EQ(removed_from(volume, {0, 100}).first.labels, volume.labels);
}

/// A voxel between 1 (above and below, small faces are large ones here) and 2 (the four sides).
TEST(RemoveSpecks, WeighsFacesByTheirArea) {
  LabelVolume volume = make_volume(6, 3, 3, [](int i, int j, int k) {
    if (i > 2) return i > 3 ? 3 : 0;
    if (i == 1 && j == 1 && k == 1) return 3;
    return k != 1 ? 1 : 2;
  });
  EXPECT_EQ(removed_from(volume, {2, 0}).first.at(1, 1, 1), 2);
  volume.index_to_mm.diagonal() = Eigen::Vector4d(1, 1, 0.4, 1);
  EXPECT_EQ(removed_from(volume, {2, 0}).first.at(1, 1, 1), 1);
}

TEST(PrepareVolume, SharesOneVolumeWhereNothingIsChanged) {
  RunContext ctx;
  VolumeParams params;
  params.flat_border = false;  // the image cuts the halves off
  const Result<PreparedVolume> out =
      prepare_volume(std::make_shared<LabelVolume>(halves()), {1, 2}, {}, params, ctx);
  ASSERT_TRUE(out.ok());
  EXPECT_EQ(out->selected, out->prepared);
}

// The mesh is held against what cleaning has left, or it would lack what was taken away on purpose.
TEST(PrepareVolume, TheReferenceIsTheCleanedOne) {
  RunContext ctx;
  VolumeParams params;
  params.flat_border = false;
  params.speck_voxels = 3;
  const auto volume = std::make_shared<const LabelVolume>(halves());
  const Result<PreparedVolume> out = prepare_volume(volume, {}, {}, params, ctx);
  ASSERT_TRUE(out.ok());
  EXPECT_EQ(out->selected, out->prepared);
  EXPECT_NE(out->selected->labels, volume->labels);
}

TEST(PrepareVolume, InterpolatesAllLabelsBeforeItSelects) {
  RunContext ctx;
  const auto volume = std::make_shared<LabelVolume>(test::heart_volume(30, 30, 6));
  volume->index_to_mm(2, 2) = 6;
  const Result<PreparedVolume> out = prepare_volume(volume, {1, 2}, {{1, 2}}, {}, ctx);
  ASSERT_TRUE(out.ok());
  EXPECT_EQ(out->selected->size, volume->size);
  EXPECT_EQ(out->prepared->size, (std::array<int, 3>{30, 30, 30}));
  EXPECT_EQ(count_labels(*out->prepared).size(), 1U);
  const Result<PreparedVolume> never = prepare_volume(volume, {1, 2}, {}, {0, 0, 0, 0}, ctx);
  EXPECT_EQ(never->selected, never->prepared);
}

TEST(PrepareVolume, RefusesANegativeRatio) {
  RunContext ctx;
  const Result<PreparedVolume> out =
      prepare_volume(std::make_shared<LabelVolume>(halves()), {}, {}, {-1, 0, 0, 0}, ctx);
  ASSERT_FALSE(out.ok());
  EXPECT_EQ(out.error().code, ErrorCode::kUsage);
  EXPECT_NE(out.error().message.find("volume.slice_ratio"), std::string::npos);
}

}  // namespace
}  // namespace voxtet
