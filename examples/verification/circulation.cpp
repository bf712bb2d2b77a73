// Active stress, pressure curves and the closed loop of circulation beside published values.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "physics/active/active_stress.h"
#include "physics/active/pressure_curve.h"
#include "physics/circulation/closed_loop.h"
#include "physics/circulation/elastance_heart.h"
#include "verify.h"

namespace voxtet::verify {
namespace {

constexpr double kMmHg = 0.133322387415;  // kPa

/// Within so many thousandths of what is expected.
void print_within(const char* check, const std::string& what, double measured, const char* unit,
                  double expected, double thousandths, const char* source) {
  const double most = thousandths / 1000 * std::abs(expected);
  print_check(check, what, measured, unit, expected - most, expected + most,
              text("%.6g ", expected) + unit + text(", within %g %%", thousandths / 10), source);
}

/// The greatest of some values and its index.
std::pair<double, std::size_t> greatest(const std::vector<double>& values) {
  const auto most = std::max_element(values.begin(), values.end());
  return {*most, static_cast<std::size_t>(most - values.begin())};
}

void check_active_stress() {
  const char* const check = "Active stress";
  const char* const source =
      "the elastodynamics benchmark of Arostica et al. (2025), Runge-Kutta in steps of 0.01 ms";
  const ActiveStressPreset preset = active_stress_preset(ActiveStressPresetName::kElastodynamics);
  const auto stress = [&](double ms) {
    return active_stress_kpa(preset.lv, preset.start_ms, preset.end_ms, ms);
  };
  std::vector<double> stresses;
  for (int i = 0; i <= 10'000; ++i) stresses.push_back(stress(i / 10.0));
  print_within(check, "greatest", greatest(stresses).first, "kPa", 118.11, 1, source);
  print_within(check, "when", static_cast<double>(greatest(stresses).second) / 10, "ms", 479.5, 1, source);
  for (const auto& [ms, kpa] :
       {std::pair{200, 22.70}, std::pair{300, 72.79}, std::pair{400, 103.17}, std::pair{500, 75.74}})
    print_within(check, "at " + std::to_string(ms) + " ms", stress(ms), "kPa", kpa, 1, source);
  for (const auto& [name, most] : {std::pair{"monoventricle", 16.074}, std::pair{"biventricle_lv", 16.491},
                                   std::pair{"biventricle_rv", 4.163}}) {
    const auto pressures = pressures_kpa(value_or_exit(pressure_curve(name)), 1000, 0.1);
    print_within("Pressure curve", std::string(name) + ", greatest", greatest(pressures).first, "kPa", most,
                 1, source);
  }
}

void check_closed_loop() {
  const char* const check = "Closed loop of Regazzoni et al. (2022)";
  const char* const published = "the state to which beats return in the program circulation";
  const char* const euler = "the same equations by forward Euler in steps of 0.1 ms, valves as published";
  constexpr int kBeats = 10, kSteps = 800;
  const ClosedLoopHeart heart = regazzoni_heart();
  const ClosedLoop circulation(heart.loop);
  const HeartState start = start_of(heart);
  HeartBeat beat{start, {}};
  for (int i = 0; i < kBeats; ++i)
    beat = value_or_exit(beat_heart(circulation, {heart.left_ventricle, heart.right_ventricle},
                                    heart.loop.period_s, beat.end, kSteps));
  const auto print_state = [&](std::string name, double measured, double expected) {
    const std::size_t unit =
        name.find("_ml_per_s") != std::string::npos ? name.find("_ml_per_s") : name.rfind('_');
    const char* const units = name.ends_with("_kpa") ? "kPa" : name.ends_with("_s") ? "ml/s" : "ml";
    name.resize(unit);
    std::replace(name.begin(), name.end(), '_', ' ');
    print_within(check, "after ten beats, " + name, measured, units, expected, 10, published);
  };
  print_state("left_ventricle_ml", beat.end.cavity_ml[0], start.cavity_ml[0]);
  print_state("right_ventricle_ml", beat.end.cavity_ml[1], start.cavity_ml[1]);
  const auto names = circulation.state_names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    print_state(std::string(names[i]), beat.end.circulation[at], start.circulation[at]);
  }
  const double blood = circulation.blood_ml(start.circulation) + start.cavity_ml.sum();
  print_check(check, "blood lost in ten beats",
              std::abs(circulation.blood_ml(beat.end.circulation) + beat.end.cavity_ml.sum() - blood), "ml",
              0, 1e-6, "none, within 1e-6 ml", "the loop is closed");
  struct Expected {
    const char* name;
    double most_ml, least_ml, most_mmhg;
  };
  const Expected expected[] = {{"left ventricle", 136.754, 66.966, 119.693},
                               {"right ventricle", 181.556, 111.769, 25.056}};
  for (std::size_t c = 0; c < 2; ++c) {
    const auto& [name, most_ml, least_ml, most_mmhg] = expected[c];
    const std::string of = name;
    print_within(check, of + ", end-diastolic volume", beat.cavities[c].most_ml, "ml", most_ml, 3, euler);
    print_within(check, of + ", end-systolic volume", beat.cavities[c].least_ml, "ml", least_ml, 3, euler);
    print_within(check, of + ", greatest pressure", beat.cavities[c].most_kpa / kMmHg, "mmHg", most_mmhg, 3,
                 euler);
  }
}

}  // namespace

void print_circulation(bool) {
  check_active_stress();
  check_closed_loop();
}

}  // namespace voxtet::verify
