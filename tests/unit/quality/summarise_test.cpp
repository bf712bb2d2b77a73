#include "quality/summarise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace voxtet {
namespace {

TEST(Summarise, MatchesBruteForceOnRandomValues) {
  std::mt19937 random(3);
  std::normal_distribution<float> normal(2, 1);
  for (const std::size_t count : {1U, 2U, 7U, 100U, 12345U}) {
    std::vector<float> values(count);
    for (float& v : values) v = normal(random);
    std::vector<float> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    const MetricSummary s = summarise({"x", "mm", "tets", 0, 4, MetricInfo::Worst::kLowest}, values, 16);
    const auto at = [&](double q) {
      return sorted[static_cast<std::size_t>(std::max(0.0, std::ceil(q * static_cast<double>(count)) - 1))];
    };
    EXPECT_EQ(s.min, sorted.front());
    EXPECT_EQ(s.p01, at(0.001));
    EXPECT_EQ(s.p1, at(0.01));
    EXPECT_EQ(s.p5, at(0.05));
    EXPECT_EQ(s.median, at(0.5));
    EXPECT_EQ(s.p95, at(0.95));
    EXPECT_EQ(s.p99, at(0.99));
    EXPECT_EQ(s.max, sorted.back());
    EXPECT_NEAR(s.mean, std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(count),
                1e-6);
    EXPECT_EQ(std::accumulate(s.histogram.counts.begin(), s.histogram.counts.end(), std::uint64_t{0}), count);
    ASSERT_EQ(s.worst.size(), std::min<std::size_t>(100, count));
    for (std::size_t i = 0; i < s.worst.size(); ++i) EXPECT_EQ(values[s.worst[i]], sorted[i]);
  }
}

TEST(Summarise, PutsOutliersInTheOuterBinsAndOrdersTiesById) {
  const float huge = std::numeric_limits<float>::infinity();
  const MetricSummary s =
      summarise({"x", "1", "tets", 0, 1, MetricInfo::Worst::kHighest}, {-5, 0.5F, huge, 9, huge}, 4);
  EXPECT_EQ(s.histogram.counts, (std::vector<std::uint64_t>{1, 0, 1, 3}));
  EXPECT_EQ(s.worst, (std::vector<std::uint32_t>{2, 4, 3, 1, 0}));
  EXPECT_NEAR(s.mean, 1.5, 1e-6);
}

TEST(Summarise, LeavesOutWhatIsNotANumber) {
  const float none = std::numeric_limits<float>::quiet_NaN();
  const MetricSummary s =
      summarise({"x", "1", "tets", 0, 1, MetricInfo::Worst::kLowest}, {none, 0.75F, none, 0.25F}, 2);
  EXPECT_EQ(s.count, 2U);
  EXPECT_EQ(s.histogram.counts, (std::vector<std::uint64_t>{1, 1}));
  EXPECT_EQ(s.worst, (std::vector<std::uint32_t>{3, 1}));
  EXPECT_EQ(s.max, 0.75);
  EXPECT_EQ(s.mean, 0.5);
}

TEST(Summarise, IsAllZeroForNothing) {
  const MetricSummary s = summarise({"x", "1", "tets", 0, 1, MetricInfo::Worst::kLowest}, {}, 4);
  EXPECT_EQ(s.count, 0U);
  EXPECT_EQ(s.max, 0);
}

}  // namespace
}  // namespace voxtet
