#include "volume/remove_specks.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/label_bodies.h"
#include "volume/prepare_volume.h"

namespace voxtet {
namespace {

using test::make_volume;

struct Heard {
  std::vector<std::string> notes, warnings;
  RunContext ctx;
  Heard() {
    ctx.on_note = [this](const std::string&, const std::string& text) { notes.push_back(text); };
    ctx.on_warning = [this](const std::string&, const std::string& text) { warnings.push_back(text); };
  }
};

/// Two halves of labels 1 and 2 with a speck of 3 (2 voxels) in the first, one of 1 (1 voxel) in the second,
/// and a hole (1 voxel) in the first.
LabelVolume halves() {
  return make_volume(12, 6, 6, [](int i, int j, int k) {
    if (j == 3 && k == 3) {
      if (i == 1 || i == 2) return 3;
      if (i == 4) return 0;
      if (i == 9) return 1;
    }
    return i < 6 ? 1 : 2;
  });
}

TEST(RemoveSpecks, DoesNothingUnlessAsked) {
  Heard heard;
  EXPECT_EQ(remove_specks(halves(), {}, heard.ctx).labels, halves().labels);
  EXPECT_TRUE(heard.notes.empty());
}

TEST(RemoveSpecks, GivesSpecksAndHolesToTheirSurroundingsAndReportsThem) {
  Heard heard;
  const LabelVolume out = remove_specks(halves(), {3, 2}, heard.ctx);
  EXPECT_EQ(out.at(1, 3, 3), 1);
  EXPECT_EQ(out.at(4, 3, 3), 1);
  EXPECT_EQ(out.at(9, 3, 3), 2);
  EXPECT_EQ(heard.notes,
            (std::vector<std::string>{"removed 1 hole: 1 voxel, the largest of 1",
                                      "removed 1 speck of label 1: 1 voxel, the largest of 1",
                                      "removed 1 speck of label 3: 2 voxels, the largest of 2"}));
  ASSERT_EQ(heard.warnings.size(), 1U);
  EXPECT_NE(heard.warnings[0].find("label 3 was removed altogether"), std::string::npos);
}

TEST(RemoveSpecks, LeavesNothingOfSpecksInsideOfSpecks) {
  // One voxel of 3 inside 26 of 2, and two specks side by side.
  const LabelVolume volume = make_volume(14, 9, 9, [](int i, int j, int k) {
    if (i == 3 && j == 4 && k == 4) return 3;
    if (i >= 2 && i <= 4 && j >= 3 && j <= 5 && k >= 3 && k <= 5) return 2;
    if (j == 4 && k == 4 && (i == 9 || i == 10)) return i == 9 ? 4 : 5;
    return 1;
  });
  Heard heard;
  EXPECT_EQ(remove_specks(volume, {30, 0}, heard.ctx).labels, std::vector<Label>(volume.labels.size(), 1));
  const LabelVolume out = remove_specks(volume, {10, 0}, heard.ctx);
  EXPECT_EQ(out.at(3, 4, 4), 2);
  EXPECT_EQ(out.at(2, 4, 4), 2);
}

TEST(RemoveSpecks, KeepsWhatIsLargeEnough) {
  Heard heard;
  const LabelVolume out = remove_specks(halves(), {2, 0}, heard.ctx);
  EXPECT_EQ(out.at(1, 3, 3), 3);
  EXPECT_EQ(out.at(4, 3, 3), 0);
  EXPECT_EQ(out.at(9, 3, 3), 2);
}

TEST(RemoveSpecks, KeepsBackgroundThatReachesTheBorder) {
  Heard heard;
  const LabelVolume volume =
      make_volume(5, 5, 5, [](int i, int j, int k) { return i == 2 && j == 2 && k == 0 ? 0 : 1; });
  EXPECT_EQ(remove_specks(volume, {0, 100}, heard.ctx).labels, volume.labels);
}

/// A voxel between 1 (above and below, small faces are large ones here) and 2 (the four sides).
TEST(RemoveSpecks, WeighsFacesByTheirArea) {
  LabelVolume volume = make_volume(3, 3, 3, [](int i, int j, int k) {
    if (i == 1 && j == 1 && k == 1) return 3;
    return k != 1 ? 1 : 2;
  });
  Heard heard;
  EXPECT_EQ(remove_specks(volume, {2, 0}, heard.ctx).at(1, 1, 1), 2);
  volume.index_to_mm.diagonal() = Eigen::Vector4d(1, 1, 0.4, 1);
  EXPECT_EQ(remove_specks(volume, {2, 0}, heard.ctx).at(1, 1, 1), 1);
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

TEST(PrepareVolume, InterpolatesAllLabelsBeforeItSelects) {
  RunContext ctx;
  const auto volume = std::make_shared<LabelVolume>(test::heart_volume(30, 30, 6));
  volume->index_to_mm(2, 2) = 6;
  const Result<PreparedVolume> out = prepare_volume(volume, {1, 2}, {{1, 2}}, {}, ctx);
  ASSERT_TRUE(out.ok());
  EXPECT_EQ(out->selected->size, volume->size);
  EXPECT_EQ(out->prepared->size, (std::array<int, 3>{30, 30, 30}));
  EXPECT_EQ(count_labels(*out->prepared).size(), 1U);
  const Result<PreparedVolume> never = prepare_volume(volume, {1, 2}, {}, {0, 0, 0}, ctx);
  EXPECT_EQ(never->selected, never->prepared);
}

TEST(PrepareVolume, RefusesANegativeRatio) {
  RunContext ctx;
  const Result<PreparedVolume> out =
      prepare_volume(std::make_shared<LabelVolume>(halves()), {}, {}, {-1, 0, 0}, ctx);
  ASSERT_FALSE(out.ok());
  EXPECT_EQ(out.error().code, ErrorCode::kUsage);
  EXPECT_NE(out.error().message.find("volume.slice_ratio"), std::string::npos);
}

}  // namespace
}  // namespace voxtet
