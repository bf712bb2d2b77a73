#include "base/id_set.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>

namespace voxtet {
namespace {

TEST(IdSet, HoldsWhatAnOrdinarySetHolds) {
  IdSet ids;
  std::uint32_t random = 1;
  for (const std::size_t count : {3, 2000, 40, 0, 500}) {
    std::set<std::uint32_t> held;
    ids.clear();
    for (std::size_t i = 0; i < count; ++i) {
      random = random * 1664525U + 1013904223U;
      // Few numbers, far apart: many are met again, and many fall into the same slots.
      const std::uint32_t id = random % 701 * 65536U;
      EXPECT_EQ(ids.insert(id), held.insert(id).second) << id;
    }
  }
}

}  // namespace
}  // namespace voxtet
