#include <gtest/gtest.h>

#include "bench/verify_physics/verify.h"

namespace voxtet {
namespace {

/// Published in examples/conduction-velocity, and there measured with another code too.
TEST(WaveSpeed, OfHalfLumpedMassErrsByAFifthOfWhatLumpedMassErrs) {
  const verify::Way lumped{"lumped", Integration::kSemiImplicit, 0},
      half{"half", Integration::kSemiImplicit, 0.5};
  const double fine = verify::fine_speed(verify::params_of(half, 0.05));
  const auto bar = verify::bar_of_tets(1.59);
  const double slow = verify::speed_along(bar, verify::params_of(lumped, 0.05)) / fine - 1;
  const double close = verify::speed_along(bar, verify::params_of(half, 0.05)) / fine - 1;
  EXPECT_NEAR(100 * slow, -6.6, 0.5);
  EXPECT_NEAR(100 * close, -0.4, 0.5);
}

}  // namespace
}  // namespace voxtet
