#include "physics/monodomain/activation_log.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/digest.h"
#include "physics/monodomain/monodomain.h"
#include "support/bricks.h"

namespace voxtet {
namespace {

constexpr float kNoBeat = std::numeric_limits<float>::quiet_NaN();

/// Equal, where NaN is equal to NaN.
void expect_times(const std::vector<float>& found, const std::vector<float>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_TRUE(found[i] == expected[i] || (std::isnan(found[i]) && std::isnan(expected[i])))
        << i << ": " << found[i] << ", expected " << expected[i];
}

TEST(ActivationLog, HasATimeOfEachBeatForEachPoint) {
  // Point 0 beats twice, point 1 three times without its last recovery, point 2 never.
  const ActivationLog log({{0, 5}, {1, 7}, {1, 300}, {0, 310}, {1, 600}},
                          {{1, 250}, {0, 255}, {0, 520}, {1, 530}});
  const auto beats = log.beats(3, 10);
  ASSERT_EQ(beats.size(), 3U);
  expect_times(beats[0].activated_ms, {5, 7, kNoBeat});
  expect_times(beats[0].repolarised_ms, {255, 250, kNoBeat});
  expect_times(beats[1].activated_ms, {310, 300, kNoBeat});
  expect_times(beats[1].repolarised_ms, {520, 530, kNoBeat});
  expect_times(beats[2].activated_ms, {kNoBeat, 600, kNoBeat});
  expect_times(beats[2].repolarised_ms, {kNoBeat, kNoBeat, kNoBeat});
  expect_times(log.last_activation(3), {310, 600, kNoBeat});
}

TEST(ActivationLog, BeatsAreAtLeastOneAndNoMoreThanAsked) {
  const auto none = ActivationLog().beats(2, 10);
  ASSERT_EQ(none.size(), 1U);
  expect_times(none[0].activated_ms, {kNoBeat, kNoBeat});
  const ActivationLog log({{0, 1}, {0, 2}, {0, 3}}, {{0, 4}});
  const auto two = log.beats(1, 2);
  ASSERT_EQ(two.size(), 2U);
  // Excited again before it had recovered: both activations end with one repolarisation.
  for (const auto& beat : two) expect_times(beat.repolarised_ms, {4});
}

/// A bar of 20 mm along x that is paced at its end twice, at 0 and at `s2_ms`.
std::vector<Field> paced_twice(const TetMesh& bar, double s2_ms) {
  Stimulus stimulus;
  stimulus.shape = RegionShape::kBox;
  stimulus.half_size_mm = {1, 9, 9};
  stimulus.count = 2;
  stimulus.interval_ms = s2_ms;
  const Tissue tissue{{TissueKind{}}, std::vector<std::uint16_t>(bar.tets.size(), 0), {}, {}};
  auto heart = Monodomain::start(bar, tissue, {stimulus}, {.end_ms = s2_ms + 320, .step_ms = 0.1});
  EXPECT_TRUE(heart.ok());
  while (!heart->done()) EXPECT_TRUE(heart->advance().ok());
  return heart->activation_fields();
}

TEST(ActivationFields, OfS1AndS2AreApartByTheirIntervalWhereTheTissueHasRecovered) {
  const TetMesh bar = test::bricks({20, 1, 1}, {40, 2, 2});
  const std::vector<Field> fields = paced_twice(bar, 1000);
  const Field* second = find_field(fields, "activation_2_ms");
  ASSERT_TRUE(second);
  EXPECT_EQ(second->title, "Activation time (beat 2)");
  EXPECT_FALSE(find_field(fields, "activation_3_ms"));
  // After 700 ms of recovery the gate is open but for 0.3 %, which costs 0.1 ms on a way of 40 ms.
  for (std::size_t i = 0; i < bar.points.size(); ++i) {
    const float interval = second->values[i] - find_field(fields, "activation_ms")->values[i];
    EXPECT_TRUE(interval >= 1000 && interval < 1000.1F) << interval;
  }
  EXPECT_EQ(find_field(fields, "last_activation_ms")->values, second->values);
}

TEST(ActivationFields, OfAnEarlyS2AreThoseOfASlowerWaveWithABrieferActionPotential) {
  const TetMesh bar = test::bricks({20, 1, 1}, {40, 2, 2});
  const std::vector<Field> fields = paced_twice(bar, 330);
  const auto at = [&](const char* name, std::size_t point) -> double {
    return find_field(fields, name)->values[point];
  };
  const auto per_mm = [&](const char* name, std::size_t point) {
    return (at(name, point + 2) - at(name, point - 2)) /
           (bar.points[point + 2][0] - bar.points[point - 2][0]);
  };
  const CellParams cell;
  for (const std::size_t point : {16, 20, 26}) {
    // The gate opens from a value that is above 0 and below 4 tau_in / tau_out, at which repolarisation
    // begins.
    const double rest = at("activation_2_ms", point) - at("repolarisation_ms", point);
    const double closed = std::exp(-rest / cell.tau_open_ms), least = 4 * cell.tau_in_ms / cell.tau_out_ms;
    const double slower = per_mm("activation_ms", point) / per_mm("activation_2_ms", point);
    EXPECT_GT(slower, plane_wave_speed(cell, 1 - closed) / plane_wave_speed(cell));
    EXPECT_LT(slower, plane_wave_speed(cell, 1 - (1 - least) * closed) / plane_wave_speed(cell));
    EXPECT_LT(at("repolarisation_2_ms", point) - at("activation_2_ms", point), at("apd_ms", point));
  }
}

TEST(ActivationFields, OfTwoBeatsHaveTheSameBytesOnEveryPlatform) {
  Sha256 digest;
  for (const Field& field : paced_twice(test::bricks({20, 1, 1}, {20, 1, 1}), 330))
    digest.update_values(field.values.data(), field.values.size());
  EXPECT_EQ(digest.hex().substr(0, 16), "7379b0aabc2b1d31");
}

}  // namespace
}  // namespace voxtet
