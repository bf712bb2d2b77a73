#include "physics/active/active_stress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/digest.h"
#include "physics/active/pressure_curve.h"

namespace voxtet {
namespace {

using Preset = ActiveStressPresetName;

/// The law by Runge's and Kutta's method with functions of the math library, in steps of 0.01 ms: kPa at
/// each of them, to 1 s.
std::vector<double> by_small_steps(const ActiveStressLaw& law, double start_ms, double end_ms) {
  const auto slope = [&](double t, double stress) {
    const double f =
        (1 + std::tanh((t - start_ms) / law.switch_ms)) * (1 - std::tanh((t - end_ms) / law.switch_ms)) / 4;
    const double a = (law.rise_per_s * f - law.fall_per_s * (1 - f)) / 1000;
    return law.peak_kpa * std::max(a, 0.0) - std::abs(a) * stress;
  };
  constexpr double kStep = 0.01;
  std::vector<double> stresses{0};
  for (int i = 0; i < 100'000; ++i) {
    const double t = i * kStep, now = stresses.back();
    const double k1 = slope(t, now), k2 = slope(t + kStep / 2, now + kStep / 2 * k1),
                 k3 = slope(t + kStep / 2, now + kStep / 2 * k2), k4 = slope(t + kStep, now + kStep * k3);
    stresses.push_back(now + kStep / 6 * (k1 + 2 * k2 + 2 * k3 + k4));
  }
  return stresses;
}

/// The greatest value of a curve and where it is.
template <class Curve>
std::pair<double, double> greatest(const Curve& curve, double end_ms, double step_ms) {
  std::pair<double, double> found{0, 0};
  for (int i = 0; i * step_ms <= end_ms; ++i)
    if (const double value = curve(i * step_ms); value > found.first) found = {value, i * step_ms};
  return found;
}

TEST(ActiveStress, HasTheValuesOfTheElastodynamicsBenchmark) {
  const ActiveStressPreset preset = active_stress_preset(Preset::kElastodynamics);
  const auto stress = [&](double ms) {
    return active_stress_kpa(preset.lv, preset.start_ms, preset.end_ms, ms);
  };
  const auto [most, at_ms] = greatest(stress, 1000, 0.1);
  EXPECT_NEAR(most, 118.11, 118.11e-3);
  EXPECT_NEAR(at_ms, 479.5, 0.1);
  for (const auto& [ms, kpa] :
       {std::pair{200, 22.70}, std::pair{300, 72.79}, std::pair{400, 103.17}, std::pair{500, 75.74}})
    EXPECT_NEAR(stress(ms), kpa, 1e-3 * kpa) << ms;
}

TEST(ActiveStress, SolvesItsEquation) {
  for (const Preset name : {Preset::kElastodynamics, Preset::kAmbit}) {
    const ActiveStressPreset preset = active_stress_preset(name);
    const std::vector<double> steps = by_small_steps(preset.lv, preset.start_ms, preset.end_ms);
    for (std::size_t i = 0; i < steps.size(); i += 100)
      EXPECT_NEAR(active_stress_kpa(preset.lv, preset.start_ms, preset.end_ms, static_cast<double>(i) / 100),
                  steps[i], 1e-5)
          << static_cast<int>(name) << ' ' << i / 100;
  }
}

TEST(ActiveStress, SolvesItsEquationWhereTheSwitchesOverlap) {
  const ActiveStressLaw law{80, 25, 20, 20};
  for (const double end_ms : {325.0, 340.0, 400.0}) {
    const std::vector<double> steps = by_small_steps(law, 300, end_ms);
    double most = 0;
    for (std::size_t i = 0; i < steps.size(); i += 100) {
      const double found = active_stress_kpa(law, 300, end_ms, static_cast<double>(i) / 100);
      EXPECT_NEAR(found, steps[i], 1e-5) << end_ms << ' ' << i / 100;
      most = std::max(most, found);
    }
    EXPECT_GT(most, 0.5) << end_ms;
  }
}

TEST(ActiveStress, OfTheReducedLawAreTwoExponentials) {
  const ActiveStressPreset preset = active_stress_preset(Preset::kFast);
  EXPECT_EQ(preset.lv.peak_kpa, 80);
  EXPECT_EQ(preset.rv.peak_kpa, 50);
  const double start = 37, end = start + 240;
  const double most = 80 * (1 - std::exp(-25 * 0.240));
  EXPECT_EQ(active_stress_kpa(preset.lv, start, end, start), 0);
  EXPECT_NEAR(active_stress_kpa(preset.lv, start, end, start + 60), 80 * (1 - std::exp(-25 * 0.06)), 1e-12);
  EXPECT_NEAR(active_stress_kpa(preset.lv, start, end, end), most, 1e-12);
  EXPECT_NEAR(active_stress_kpa(preset.lv, start, end, end + 100), most * std::exp(-20 * 0.1), 1e-12);
}

TEST(ActiveStress, OfShortSwitchesComesToThatOfJumps) {
  ActiveStressLaw law{80, 25, 20, 0};
  std::vector<double> jump, error;
  for (double t = 5; t < 600; t += 10) jump.push_back(active_stress_kpa(law, 100, 340, t));
  for (const double ms : {4.0, 2.0, 1.0}) {
    law.switch_ms = ms;
    double worst = 0;
    for (std::size_t i = 0; i < jump.size(); ++i)
      worst = std::max(worst,
                       std::abs(active_stress_kpa(law, 100, 340, 5 + 10 * static_cast<double>(i)) - jump[i]));
    error.push_back(worst);
  }
  EXPECT_NEAR(error[0] / error[1], 2, 0.2);
  EXPECT_NEAR(error[1] / error[2], 2, 0.2);
}

TEST(ActiveStress, IsNothingWhereNoWaveComes) {
  constexpr double kNever = std::numeric_limits<double>::quiet_NaN();
  for (const double switch_ms : {0.0, 5.0}) {
    const ActiveStressLaw law{80, 25, 20, switch_ms};
    EXPECT_EQ(active_stress_kpa(law, kNever, kNever, 300), 0);
    EXPECT_EQ(active_stress_kpa(law, 100, kNever, 300), 0);
    EXPECT_EQ(active_stress_kpa(law, 100, 100, 300), 0);
    EXPECT_EQ(active_stress_kpa(law, 100, 400, 50), 0);
    EXPECT_LT(active_stress_kpa(law, 100, 400, 5000), 1e-30);
  }
}

TEST(ActiveStress, TellsWhatIsWrong) {
  EXPECT_TRUE(check_active_stress({}).ok());
  EXPECT_EQ(check_active_stress({80, 0, 20, 0}).error().message,
            "active stress, rise_per_s: found 0, expected a number > 0");
  EXPECT_EQ(check_active_stress({-1, 25, 20, 0}).error().message,
            "active stress, peak_kpa: found -1, expected a number >= 0");
  EXPECT_FALSE(check_active_stress({80, 25, std::nan(""), 0}).ok());
}

TEST(PressureCurve, HasTheGreatestValuesOfTheElastodynamicsBenchmark) {
  const auto most = [](const char* name) {
    const std::vector<double> p = pressures_kpa(pressure_curve(name).value(), 1000, 0.1);
    return greatest([&](double ms) { return p[static_cast<std::size_t>(std::lround(ms * 10))]; }, 1000, 0.1);
  };
  EXPECT_NEAR(most("monoventricle").first, 16.074, 16.074e-3);
  EXPECT_NEAR(most("monoventricle").second, 481.7, 0.1);
  EXPECT_NEAR(most("biventricle_lv").first, 16.491, 16.491e-3);
  EXPECT_NEAR(most("biventricle_rv").first, 4.163, 4.163e-3);
}

TEST(PressureCurve, DoesNotDependOnTheStep) {
  const PressureCurve curve = pressure_curve("monoventricle").value();
  const std::vector<double> coarse = pressures_kpa(curve, 1000, 5), fine = pressures_kpa(curve, 1000, 0.01);
  ASSERT_EQ(coarse.size(), 201U);
  ASSERT_EQ(fine.size(), 100'001U);
  for (std::size_t i = 0; i < coarse.size(); ++i) EXPECT_NEAR(coarse[i], fine[500 * i], 1e-6) << i;
}

TEST(PressureCurve, TellsWhichThereAre) {
  const auto unknown = pressure_curve("atrium");
  ASSERT_FALSE(unknown.ok());
  EXPECT_EQ(
      unknown.error().message,
      "pressure curve: found \"atrium\", expected one of monoventricle, biventricle_lv, biventricle_rv");
}

TEST(ActiveStress, SameBytesOnEveryPlatform) {
  Sha256 sha;
  for (const Preset name : {Preset::kElastodynamics, Preset::kAmbit, Preset::kFast}) {
    const ActiveStressPreset preset = active_stress_preset(name);
    for (int ms = 0; ms < 1000; ms += 7) {
      const double stress = active_stress_kpa(preset.lv, 100, 400, ms);
      sha.update_values(&stress, 1);
    }
  }
  const std::vector<double> pressures = pressures_kpa(pressure_curve("biventricle_rv").value(), 1000, 1);
  sha.update_values(pressures.data(), pressures.size());
  EXPECT_EQ(sha.hex().substr(0, 16), "f8c824c00a4df18c");
}

}  // namespace
}  // namespace voxtet
