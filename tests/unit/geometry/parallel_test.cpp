#include "geometry/parallel.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace voxtet {
namespace {

TEST(ParallelFor, VisitsEveryIndexOnce) {
  for (const int threads : {-1, 0, 1, 2, 7})
    for (const std::size_t count : {0U, 1U, 3U, 100U}) {
      std::vector<int> visits(count, 0);
      parallel_for(threads, count, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) ++visits[i];
      });
      EXPECT_EQ(visits, std::vector<int>(count, 1)) << threads;
    }
}

TEST(ParallelFor, RethrowsAfterAllPartsHaveEnded) {
  for (const int threads : {1, 3}) {
    std::vector<int> visits(30, 0);
    EXPECT_THROW(parallel_for(threads, visits.size(),
                              [&](std::size_t first, std::size_t last) {
                                for (std::size_t i = first; i < last; ++i) visits[i] = 1;
                                if (last == visits.size()) throw std::runtime_error("last part");
                              }),
                 std::runtime_error);
    EXPECT_EQ(visits, std::vector<int>(30, 1));
  }
}

}  // namespace
}  // namespace voxtet
