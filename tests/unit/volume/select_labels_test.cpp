#include "volume/select_labels.h"

#include <gtest/gtest.h>

#include <string>

namespace voxtet {
namespace {

std::shared_ptr<const LabelVolume> row(std::vector<Label> labels) {
  LabelVolume volume;
  volume.size = {static_cast<int>(labels.size()), 1, 1};
  volume.labels = std::move(labels);
  volume.infos = {{1, "one"}, {2, "two"}, {7, "seven"}};
  return std::make_shared<const LabelVolume>(std::move(volume));
}

TEST(SelectLabels, MakesTheOthersBackground) {
  const auto out = select_labels(row({0, 1, 2, 7, 1}), {7, 1}, {});
  ASSERT_TRUE(out.ok());
  EXPECT_EQ((*out)->labels, (std::vector<Label>{0, 1, 0, 7, 1}));
  ASSERT_EQ((*out)->infos.size(), 2U);
  EXPECT_EQ((*out)->infos[1].name, "seven");
}

TEST(SelectLabels, MergesToTheSmallest) {
  const auto out = select_labels(row({0, 1, 2, 7}), {7, 2}, {{7, 2}});
  ASSERT_TRUE(out.ok());
  EXPECT_EQ((*out)->labels, (std::vector<Label>{0, 0, 2, 2}));
  ASSERT_EQ((*out)->infos.size(), 1U);
  EXPECT_EQ((*out)->infos[0].label, 2);
}

TEST(SelectLabels, TakesAllWhenNoneIsNamed) {
  const auto out = select_labels(row({0, 1, 2}), {}, {});
  EXPECT_EQ((*out)->labels, (std::vector<Label>{0, 1, 2}));
  EXPECT_EQ((*out)->infos.size(), 2U);
}

TEST(SelectLabels, CopiesNothingWhereAllIsKept) {
  const auto whole = row({0, 1, 2, 7});
  EXPECT_EQ(*select_labels(whole, {}, {}), whole);
  EXPECT_EQ(*select_labels(whole, {7, 2, 1}, {{2}}), whole);
  EXPECT_NE(*select_labels(whole, {1, 2}, {}), whole);
  EXPECT_NE(*select_labels(whole, {}, {{1, 2}}), whole);
}

TEST(SelectLabels, NamesTheMissingLabelAndThoseThere) {
  const auto out = select_labels(row({0, 1, 2}), {1, 9}, {});
  ASSERT_FALSE(out.ok());
  EXPECT_EQ(out.error().code, ErrorCode::kUsage);
  EXPECT_NE(out.error().message.find("no label 9; it holds 1, 2"), std::string::npos) << out.error().message;
}

TEST(SelectLabels, RefusesAnEmptyVolume) {
  EXPECT_EQ(select_labels(row({0, 0}), {}, {}).error().code, ErrorCode::kBadInput);
}

std::string merge_error(const std::vector<Label>& wanted, const std::vector<LabelGroup>& merge) {
  const auto out = select_labels(row({0, 1, 2, 7}), wanted, merge);
  if (out.ok()) return "";
  EXPECT_EQ(out.error().code, ErrorCode::kUsage);
  return out.error().message;
}

TEST(SelectLabels, MergesGroupsApart) {
  const auto out = select_labels(row({0, 1, 2, 7, 9, 4}), {}, {{9, 2}, {7}, {4, 1}});
  ASSERT_TRUE(out.ok()) << out.error().message;
  EXPECT_EQ((*out)->labels, (std::vector<Label>{0, 1, 2, 7, 2, 1}));
}

TEST(SelectLabels, NamesWhatIsWrongWithAGroup) {
  EXPECT_EQ(merge_error({}, {{1}, {}}), "merge[1]: found no label, expected a group of labels to merge");
  EXPECT_EQ(merge_error({}, {{1, 5}}), "merge[0]: the volume holds no label 5; it holds 1, 2, 7");
  EXPECT_EQ(merge_error({1, 2}, {{1, 7}}), "merge[0]: label 7 is not among the labels to mesh, 1, 2");
  EXPECT_EQ(merge_error({}, {{1, 2}, {7, 2}}),
            "merge[1]: label 2 is named already in merge[0]; a label belongs to one group");
  EXPECT_EQ(merge_error({}, {{1, 1}}),
            "merge[0]: label 1 is named already in merge[0]; a label belongs to one group");
}

TEST(CountLabels, CountsEveryLabelAscending) {
  const auto counts = count_labels(*row({7, 1, 0, 7}));
  EXPECT_EQ(counts, (std::vector<std::pair<Label, std::size_t>>{{1, 1}, {7, 2}}));
}

}  // namespace
}  // namespace voxtet
