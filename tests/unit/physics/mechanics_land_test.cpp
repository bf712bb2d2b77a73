// Problems of Land et al. (2015) on small meshes: beside the values that the codes of the paper agree on, and
// beside those of another program on meshes of the same resolution.
#include <gtest/gtest.h>

#include <cmath>

#include "support/land.h"

namespace voxtet::mechanics {
namespace {

double beam(int bricks, Formulation formulation, double bulk_kpa = 1000) {
  const auto found = test::land_beam({10 * bricks, bricks, bricks}, formulation, bulk_kpa, 10);
  EXPECT_TRUE(found) << found.error().message;
  return found ? found->deflection_mm : NAN;
}

TEST(MechanicsLand, TheBeamBendsAsInAnotherProgram) {
  // The other program gives two digits.
  EXPECT_NEAR(beam(2, Formulation::kLinear), 0.18, 0.01);
  EXPECT_NEAR(beam(2, Formulation::kAverageNodalPressure), 1.79, 0.01);
  EXPECT_NEAR(beam(1, Formulation::kQuadratic), 2.79, 0.01);
  EXPECT_NEAR(beam(2, Formulation::kQuadratic), 3.05, 0.01);
}

TEST(MechanicsLand, SofterVolumesUnlockLinearElements) {
  EXPECT_NEAR(beam(2, Formulation::kLinear, 10), 1.77, 0.01);
}

TEST(MechanicsLand, StabilisedPressuresUnlockLinearElements) {
  // Where P1 gives 0.18 mm and -21.4 mm.
  EXPECT_GT(beam(2, Formulation::kStabilised), 1.9);
  const auto heart = test::land_ventricle(false, 1, 8, Formulation::kStabilised, 1000, 10);
  ASSERT_TRUE(heart) << heart.error().message;
  EXPECT_NEAR(heart->endo_mm, -26.53, 0.03 * 26.53);
  EXPECT_NEAR(heart->epi_mm, -28.18, 0.03 * 28.18);
}

TEST(MechanicsLand, StabilisedPressuresOscillateLessThanAveragedOnes) {
  const auto averaged = test::land_beam({20, 2, 2}, Formulation::kAverageNodalPressure, 1000, 10);
  const auto stabilised = test::land_beam({20, 2, 2}, Formulation::kStabilised, 1000, 10);
  ASSERT_TRUE(averaged && stabilised);
  EXPECT_GT(averaged->result.oscillation, 0);
  EXPECT_LT(stabilised->result.oscillation, 0.7 * averaged->result.oscillation);
}

TEST(MechanicsLand, TheInflatedVentricleIsAsLongAsAllCodesAgree) {
  const auto heart = test::land_ventricle(false, 1, 6, Formulation::kQuadratic, 1000, 10);
  ASSERT_TRUE(heart) << heart.error().message;
  EXPECT_NEAR(heart->endo_mm, -26.53, 0.01 * 26.53);
  EXPECT_NEAR(heart->epi_mm, -28.18, 0.01 * 28.18);
}

TEST(MechanicsLand, TheContractedVentricleIsAsLongAsTheCodesFind) {
  const auto heart = test::land_ventricle(true, 2, 16, Formulation::kAverageNodalPressure, 1000, 5);
  ASSERT_TRUE(heart) << heart.error().message;
  EXPECT_GT(heart->endo_mm, -12.5);
  EXPECT_LT(heart->endo_mm, -12.0);
  EXPECT_GT(heart->epi_mm, -15.5);
  EXPECT_LT(heart->epi_mm, -15.2);
}

}  // namespace
}  // namespace voxtet::mechanics
