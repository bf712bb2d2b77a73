#include "physics/active/active_stress.h"

#include <array>
#include <sstream>
#include <string>
#include <utility>

#include "physics/active/switches.h"

namespace voxtet {
namespace {

constexpr ActiveStressLaw kBenchmark{150, 5, 30, 5}, kAmbit{100, 15, 30, 5};

}  // namespace

Status check_active_stress(const ActiveStressLaw& law) {
  const std::array<std::pair<const char*, double>, 4> numbers{{{"peak_kpa", law.peak_kpa},
                                                               {"rise_per_s", law.rise_per_s},
                                                               {"fall_per_s", law.fall_per_s},
                                                               {"switch_ms", law.switch_ms}}};
  for (const auto& [name, number] : numbers) {
    const bool may_be_zero = name != numbers[1].first && name != numbers[2].first;
    if (std::isfinite(number) && (number > 0 || (may_be_zero && number == 0))) continue;
    std::ostringstream text;
    text << "active stress, " << name << ": found " << number << ", expected a number "
         << (may_be_zero ? ">= 0" : "> 0");
    return usage_error("mechanics", text.str());
  }
  return std::monostate{};
}

double active_stress_kpa(const ActiveStressLaw& law, double start_ms, double end_ms, double time_ms) {
  const double rise = law.rise_per_s / 1000, fall = law.fall_per_s / 1000;
  // f is the difference of its two switches over 1 - apart^2. It is fall / (rise + fall), and a = 0, at the
  // same distance behind the start as before the end.
  const double apart = portable_exp(-(end_ms - start_ms) / law.switch_ms), squared = apart * apart;
  const double half = (rise / fall - squared) / 2;
  if (!(end_ms > start_ms) || !(half > apart)) return 0;
  const double late = -law.switch_ms / 2 * portable_log(half + std::sqrt(half * half - squared));
  const double rises = start_ms + late, falls = end_ms - late;
  if (!(time_ms > rises)) return 0;
  const auto integral_of_f = [&](double t) {
    return (active::switch_on_integral(t - start_ms, law.switch_ms) -
            active::switch_on_integral(t - end_ms, law.switch_ms)) /
           (1 - squared);
  };
  const auto integral_of_a = [&](double from, double to) {
    return (rise + fall) * (integral_of_f(to) - integral_of_f(from)) - fall * (to - from);
  };
  const double up = std::min(time_ms, falls);
  const double stress = law.peak_kpa * (1 - portable_exp(-integral_of_a(rises, up)));
  return time_ms > falls ? stress * portable_exp(integral_of_a(falls, time_ms)) : stress;
}

ActiveStressPreset active_stress_preset(ActiveStressPresetName name) {
  switch (name) {
    case ActiveStressPresetName::kFast: return {{80, 25, 20, 0}, {50, 25, 20, 0}, 0, 0};
    case ActiveStressPresetName::kAmbit: return {kAmbit, kAmbit, 200, 530};
    case ActiveStressPresetName::kElastodynamics: break;
  }
  return {kBenchmark, kBenchmark, 160, 484};
}

}  // namespace voxtet
