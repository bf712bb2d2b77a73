#include "geometry/topology/compare_topology.h"

#include <gtest/gtest.h>

namespace voxtet {
namespace {

std::vector<std::string> phrases(const TopologyLedger& before, const TopologyLedger& after) {
  std::vector<std::string> out;
  for (const TopologyDifference& d : compare_topology(before, after)) out.push_back(in_words(d));
  return out;
}

const TopologyLedger kLedger{{{1, 1, 0, 0, 2, 0, 0, 0}, {5, 2, 1, 3, 0, 0, 0, 0}, {6, 1, 0, 0, 2, 0, 0, 0}},
                             {{0, 1}, {1, 5}, {5, 6}}};

TEST(CompareTopology, FindsNothingBetweenEqualLedgers) {
  EXPECT_TRUE(compare_topology(kLedger, kLedger).empty());
  EXPECT_TRUE(compare_topology({}, {}).empty());
}

TEST(CompareTopology, NamesEveryNumberThatDiffers) {
  TopologyLedger after = kLedger;
  after.labels[1] = {5, 3, 0, 1, 4, 7, 8, 0};
  EXPECT_EQ(phrases(kLedger, after),
            (std::vector<std::string>{"label 5: components 2 -> 3", "label 5: cavities 1 -> 0",
                                      "label 5: handles 3 -> 1", "label 5: pinched edges 0 -> 7",
                                      "label 5: pinched points 0 -> 8"}));
}

TEST(CompareTopology, NamesContactsLostAndGained) {
  TopologyLedger after = kLedger;
  after.contacts = {{0, 5}, {1, 5}, {1, 6}};
  EXPECT_EQ(phrases(kLedger, after),
            (std::vector<std::string>{
                "label 1 and background no longer touch", "label 5 and background touch, and did not before",
                "labels 1 and 6 touch, and did not before", "labels 5 and 6 no longer touch"}));
}

TEST(CompareTopology, SaysOfALabelLostOrGainedThatAndNoMore) {
  TopologyLedger after = kLedger;
  after.labels.pop_back();
  after.labels.push_back({9, 1, 0, 0, 2, 0, 0, 0});
  after.contacts = {{0, 1}, {1, 5}, {5, 9}};
  EXPECT_EQ(phrases(kLedger, after),
            (std::vector<std::string>{"label 6 is missing", "label 9 is not in the label surface"}));
}

}  // namespace
}  // namespace voxtet
