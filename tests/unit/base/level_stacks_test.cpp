#include "base/level_stacks.h"

#include <gtest/gtest.h>

#include <string>

namespace voxtet {
namespace {

TEST(LevelStacks, GiveTheHighestLevelFirstAndInItTheLastPushed) {
  LevelStacks<char, 2> stacks({1, 2});
  const auto all = [&] {
    std::string order;
    while (const auto next = stacks.pop()) order += *next;
    return order;
  };
  EXPECT_EQ(all(), "");
  stacks.push(1.5, 'a');
  stacks.push(3, 'b');
  stacks.push(1, 'c');  // not above the limit
  stacks.push(2, 'd');
  stacks.push(2.1, 'e');
  EXPECT_EQ(all(), "ebdac");
  stacks.push(0, 'f');
  EXPECT_EQ(all(), "f");
}

}  // namespace
}  // namespace voxtet
