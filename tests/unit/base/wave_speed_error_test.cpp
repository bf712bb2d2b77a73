#include "base/wave_speed_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace voxtet {
namespace {

TEST(WaveSpeedError, IsAsMeasuredAndScalesWithTheRootOfTheDiffusivity) {
  EXPECT_NEAR(wave_speed_error_percent(2.08, 0.2118, 0), -9.7, 1e-9);
  EXPECT_NEAR(wave_speed_error_percent(2.08, 0.2118, 0.5), -1.7, 1e-9);
  // Half way between two measured shares, and between two edge lengths.
  EXPECT_NEAR(wave_speed_error_percent(2.08, 0.2118, 0.25), -5.7, 1e-9);
  EXPECT_NEAR(wave_speed_error_percent((2.08 + 3.03) / 2, 0.2118, 0), -12.25, 1e-9);
  // A speed of 0.2 mm/ms at 0.8 mm reads as one of 0.5 mm/ms at 2 mm.
  EXPECT_NEAR(wave_speed_error_percent(0.8, 0.2118 * 0.16, 0), wave_speed_error_percent(2, 0.2118, 0), 1e-9);
  EXPECT_EQ(wave_speed_error_percent(0, 0.2118, 0.5), 0);
}

TEST(WaveSpeedError, GoesOnBeyondWhatWasMeasuredWithoutAWaveThatRunsBackwards) {
  for (const double share : {0.0, 0.5, 0.75}) {
    double before = wave_speed_error_percent(3.03, 0.2118, share);
    EXPECT_NEAR(wave_speed_error_percent(3.0301, 0.2118, share), before, 0.01);
    for (double edge = 3.1; edge < 100; edge *= 1.1) {
      const double error = wave_speed_error_percent(edge, 0.2118, share);
      EXPECT_LT(error, before);
      EXPECT_GT(error, -100);
      before = error;
    }
  }
}

TEST(WaveSpeedError, EdgeForAnErrorIsTheLongestUpToWhichItIsKept) {
  for (const double share : {0.0, 0.5, 1.0})
    for (const double percent : {0.5, 1.0, 4.0}) {
      const double edge = edge_for_wave_speed_error(percent, 0.1, share);
      EXPECT_NEAR(std::abs(wave_speed_error_percent(edge, 0.1, share)), percent, 1e-3)
          << share << " " << percent;
      for (double shorter = 0; shorter < edge; shorter += 0.01)
        EXPECT_LE(std::abs(wave_speed_error_percent(shorter, 0.1, share)), percent + 1e-9);
    }
}

}  // namespace
}  // namespace voxtet
