// Problems of Land et al. (2015) on small meshes, beside published values.
#include <gtest/gtest.h>

#include "support/land.h"

namespace voxtet::mechanics {
namespace {

TEST(MechanicsLand, TheBeamBendsAsFarAsAllCodesAgree) {
  const auto beam = test::land_beam({12, 2, 2}, Formulation::kQuadratic, 1000, 4);
  ASSERT_TRUE(beam) << beam.error().message;
  EXPECT_NEAR(beam->deflection_mm, 3.17, 0.1);
}

}  // namespace
}  // namespace voxtet::mechanics
