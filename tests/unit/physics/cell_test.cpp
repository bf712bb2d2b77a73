#include "physics/monodomain/cell.h"

#include <gtest/gtest.h>

#include <cmath>

namespace voxtet {
namespace {

constexpr double kStep = 0.02;

TEST(Cell, StaysAtRestWithoutACurrent) {
  for (const bool modified : {false, true}) {
    const CellStep step({.modified = modified}, kStep);
    double v = 0, w = 1;
    for (int i = 0; i < 100'000; ++i) step.react(v, w, 0);
    EXPECT_EQ(v, 0);
    EXPECT_NEAR(w, 1, 1e-12);
  }
}

TEST(Cell, ReturnsToRestFromBelowTheThresholdAndFiresAboveIt) {
  // Without the gate's motion the threshold is the cubic's middle root.
  const CellParams cell;
  const double threshold = (1 - std::sqrt(1 - 4 * cell.tau_in_ms / cell.tau_out_ms)) / 2;
  for (const double part : {0.95, 1.05}) {
    const CellStep step(cell, kStep);
    double v = part * threshold, w = 1, highest = v;
    for (int i = 0; i < 5'000; ++i) {
      step.react(v, w, 0);
      highest = std::max(highest, v);
    }
    EXPECT_EQ(highest > 0.9, part > 1) << part;
  }
}

TEST(Cell, ActionPotentialLastsAsLongAsTheClosedFormSaysForFastCurrents) {
  double error = HUGE_VAL;
  for (const double fast : {1.0, 0.5, 0.25, 0.125}) {
    const CellParams cell{.tau_in_ms = 0.3 * fast, .tau_out_ms = 6 * fast};
    const CellStep step(cell, 0.001);
    double v = 0.5, w = 1, lasted = 0;
    for (; v > cell.gate; lasted += 0.001) step.react(v, w, 0);
    EXPECT_LT(std::abs(lasted - action_potential_duration(cell)), 0.7 * error);
    error = std::abs(lasted - action_potential_duration(cell));
  }
  EXPECT_LT(error, 0.05 * action_potential_duration({}));
}

TEST(Cell, PlaneWaveIsThatOfTheCubicAndStopsWhereTheGateIsTooFarClosed) {
  const CellParams cell;
  EXPECT_NEAR(plane_wave_speed(cell), 1.0866, 5e-5);
  EXPECT_NEAR(diffusivity_of(0.5, cell), 0.2118, 5e-5);
  // Blocked at w < 4.5 tau_in / tau_out = 0.225.
  EXPECT_EQ(plane_wave_speed(cell, 0.2249), 0);
  EXPECT_GT(plane_wave_speed(cell, 0.2251), 0);
  // Modified: the cubic v (v - gate) (1 - v) / tau_in, whose front has the speed (1 - 2 gate) sqrt(D / (2
  // tau_in)).
  CellParams modified;
  modified.modified = true;
  EXPECT_NEAR(plane_wave_speed(modified), (1 - 2 * 0.13) / std::sqrt(2 * 0.3), 1e-12);
  EXPECT_LT(plane_wave_speed(modified, 0.8), plane_wave_speed(modified));
}

TEST(Cell, GateClosesAndOpensExactlyForAConstantRate) {
  const CellParams cell;
  const CellStep step(cell, 0.05);
  double w = 0.3;
  for (int i = 0; i < 200; ++i) {
    double v = 0;  // held at rest
    step.react(v, w, 0);
  }
  EXPECT_NEAR(w, 1 - 0.7 * std::exp(-10 / cell.tau_open_ms), 1e-13);
}

TEST(Cell, ParametersOutOfRangeAreNamed) {
  EXPECT_EQ(fault_of({}), std::nullopt);
  EXPECT_NE(fault_of({.tau_close_ms = 0})->find("tau_close_ms: found 0"), std::string::npos);
  EXPECT_NE(fault_of({.tau_in_ms = 2})->find("a quarter of tau_out_ms"), std::string::npos);
  EXPECT_NE(fault_of({.gate = 0.5})->find("gate"), std::string::npos);
  EXPECT_NE(fault_of({.tau_out_ms = NAN})->find("nan"), std::string::npos);
}

}  // namespace
}  // namespace voxtet
