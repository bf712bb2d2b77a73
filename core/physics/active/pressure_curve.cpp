#include "physics/active/pressure_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "physics/active/switches.h"

namespace voxtet {
namespace {

constexpr double kMostStepMs = 0.02;  ///< ms
constexpr std::array<std::pair<std::string_view, PressureCurve>, 3> kPressureCurves{
    {{"monoventricle", {}}, {"biventricle_lv", {12, 16, 5, 15}}, {"biventricle_rv", {3, 4, 1, 10}}}};

/// dp/dt = inflow - rate p, per ms.
struct PressureRates {
  double rate, inflow;
};

PressureRates pressure_rates_at(const PressureCurve& curve, double time_ms) {
  const double g = active::switch_on(curve.end_ms - time_ms, curve.switch_ms);
  const double f = active::switch_on(time_ms - curve.start_ms, curve.switch_ms) * g;
  const double b = curve.rise_per_s * f - curve.fall_per_s * (1 - f) + curve.pre_per_s * g + curve.mid_per_s;
  return {std::abs(b) / 1000, (curve.mid_kpa * std::max(b, 0.0) + curve.pre_kpa_per_s * g) / 1000};
}

}  // namespace

Result<PressureCurve> pressure_curve(std::string_view name) {
  std::string names;
  for (const auto& [known, curve] : kPressureCurves) {
    if (known == name) return curve;
    names += (names.empty() ? "" : ", ") + std::string(known);
  }
  return usage_error("mechanics",
                     "pressure curve: found \"" + std::string(name) + "\", expected one of " + names);
}

std::vector<double> pressures_kpa(const PressureCurve& curve, double end_ms, double step_ms) {
  const int count = static_cast<int>(std::floor(end_ms / step_ms + 1e-9));
  const int substeps = std::max(1, static_cast<int>(std::ceil(step_ms / kMostStepMs - 1e-9)));
  const double h = step_ms / substeps;
  std::vector<double> pressures{0};
  double p = 0;
  for (int step = 0; step < count; ++step) {
    for (int sub = 0; sub < substeps; ++sub) {
      const double t = step * step_ms + sub * h;
      const PressureRates first = pressure_rates_at(curve, t), middle = pressure_rates_at(curve, t + h / 2),
                          last = pressure_rates_at(curve, t + h);
      const double k1 = first.inflow - first.rate * p;
      const double k2 = middle.inflow - middle.rate * (p + h / 2 * k1);
      const double k3 = middle.inflow - middle.rate * (p + h / 2 * k2);
      const double k4 = last.inflow - last.rate * (p + h * k3);
      p += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    pressures.push_back(p);
  }
  return pressures;
}

}  // namespace voxtet
