#include "pipeline/select_labels.h"

#include <gtest/gtest.h>

namespace voxtet {
namespace {

LabelVolume row(std::vector<Label> labels) {
  LabelVolume volume;
  volume.size = {static_cast<int>(labels.size()), 1, 1};
  volume.labels = std::move(labels);
  volume.infos = {{1, "one"}, {2, "two"}, {7, "seven"}};
  return volume;
}

TEST(SelectLabels, MakesTheOthersBackground) {
  const Result<LabelVolume> out = select_labels(row({0, 1, 2, 7, 1}), {7, 1}, false);
  ASSERT_TRUE(out.ok());
  EXPECT_EQ(out->labels, (std::vector<Label>{0, 1, 0, 7, 1}));
  ASSERT_EQ(out->infos.size(), 2U);
  EXPECT_EQ(out->infos[1].name, "seven");
}

TEST(SelectLabels, MergesToTheSmallest) {
  const Result<LabelVolume> out = select_labels(row({0, 1, 2, 7}), {7, 2}, true);
  ASSERT_TRUE(out.ok());
  EXPECT_EQ(out->labels, (std::vector<Label>{0, 0, 2, 2}));
  ASSERT_EQ(out->infos.size(), 1U);
  EXPECT_EQ(out->infos[0].label, 2);
}

TEST(SelectLabels, TakesAllWhenNoneIsNamed) {
  EXPECT_EQ(select_labels(row({0, 1, 2}), {}, false)->labels, (std::vector<Label>{0, 1, 2}));
}

TEST(SelectLabels, NamesTheMissingLabelAndThoseThere) {
  const Result<LabelVolume> out = select_labels(row({0, 1, 2}), {1, 9}, false);
  ASSERT_FALSE(out.ok());
  EXPECT_EQ(out.error().code, ErrorCode::kUsage);
  EXPECT_NE(out.error().message.find("no label 9; it holds 1, 2"), std::string::npos) << out.error().message;
}

TEST(SelectLabels, RefusesAnEmptyVolume) {
  EXPECT_EQ(select_labels(row({0, 0}), {}, false).error().code, ErrorCode::kBadInput);
}

TEST(CountLabels, CountsEveryLabelAscending) {
  const auto counts = count_labels(row({7, 1, 0, 7}));
  EXPECT_EQ(counts, (std::vector<std::pair<Label, std::size_t>>{{1, 1}, {7, 2}}));
}

}  // namespace
}  // namespace voxtet
