#include "volume/label_contacts.h"

#include <gtest/gtest.h>

namespace voxtet {
namespace {

TEST(LabelSurroundings, CountFacesByAreaAndTheImagesBorder) {
  LabelVolume volume;
  volume.size = {5, 4, 3};
  volume.index_to_mm.diagonal() = Eigen::Vector4d(1, 2, 3, 1);
  volume.labels.assign(volume.voxel_count(), 7);
  // Inside label 7, which fills the image, lies one voxel of label 2 beside one of label 3.
  volume.labels[volume.offset(1, 1, 1)] = 2;
  volume.labels[volume.offset(2, 1, 1)] = 3;
  const std::vector<LabelSurroundings> found = label_surroundings(volume);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].label, 2);
  EXPECT_EQ(found[1].label, 3);
  EXPECT_EQ(found[2].label, 7);
  // Faces across x have 6 mm2, across y 3, across z 2: 22 in all, of which 6 are shared.
  ASSERT_EQ(found[0].contacts.size(), 2U);
  EXPECT_EQ(found[0].contacts[0].other, 7);
  EXPECT_DOUBLE_EQ(found[0].contacts[0].share, 16.0 / 22);
  EXPECT_EQ(found[0].contacts[1].other, 3);
  EXPECT_DOUBLE_EQ(found[0].contacts[1].share, 6.0 / 22);
  EXPECT_DOUBLE_EQ(found[2].contacts[0].share, 0.5);
  EXPECT_EQ(found[2].contacts[0].other, 2);
  EXPECT_DOUBLE_EQ(found[2].border_share, 1);
  EXPECT_DOUBLE_EQ(found[0].border_share, 0);
}

TEST(LabelSurroundings, ALabelAloneTouchesTheBackground) {
  LabelVolume volume;
  volume.size = {2, 1, 1};
  volume.labels = {1, 0};
  const std::vector<LabelSurroundings> found = label_surroundings(volume);
  ASSERT_EQ(found.size(), 1U);
  ASSERT_EQ(found[0].contacts.size(), 1U);
  EXPECT_EQ(found[0].contacts[0].other, kBackground);
  EXPECT_DOUBLE_EQ(found[0].contacts[0].share, 1);
  EXPECT_DOUBLE_EQ(found[0].border_share, 0.5);
  volume.labels = {4, 4};
  EXPECT_TRUE(label_surroundings(volume)[0].contacts.empty());
}

}  // namespace
}  // namespace voxtet
