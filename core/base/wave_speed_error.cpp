#include "base/wave_speed_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace voxtet {
namespace {

/// Of the tissue in which the errors were measured, mm^2/ms.
constexpr double kDiffusivity = 0.2118;
constexpr std::array<double, 4> kShares{0, 0.5, 0.75, 1};

struct Row {
  double edge_mm;
  std::array<double, 4> percent;  ///< for each of kShares
};
/// From 0.85 mm on as `verify_physics plane_wave` prints it.
constexpr std::array<Row, 8> kMeasured{{{0, {0, 0, 0, 0}},
                                        {0.44, {-1.2, -0.1, 0.4, 1.0}},
                                        {0.65, {-2.1, 0.1, 1.4, 2.7}},
                                        {0.85, {-2.5, 0.4, 2.1, 4.0}},
                                        {1.11, {-4.1, 0.2, 2.9, 6.2}},
                                        {1.60, {-6.9, -0.5, 4.0, 10.1}},
                                        {2.08, {-9.7, -1.7, 4.3, 13.0}},
                                        {3.03, {-14.8, -4.5, 3.6, 16.3}}}};

double of_row(const Row& row, double share) {
  std::size_t s = 1;
  while (s + 1 < kShares.size() && share > kShares[s]) ++s;
  const double part = (share - kShares[s - 1]) / (kShares[s] - kShares[s - 1]);
  return (1 - part) * row.percent[s - 1] + part * row.percent[s];
}

}  // namespace

double wave_speed_error_percent(double edge_mm, double diffusivity_mm2_per_ms, double consistent_mass) {
  const double edge = edge_mm * std::sqrt(kDiffusivity / diffusivity_mm2_per_ms);
  std::size_t r = 1;
  while (r + 1 < kMeasured.size() && edge > kMeasured[r].edge_mm) ++r;
  const Row &before = kMeasured[r - 1], &after = kMeasured[r];
  const double first = of_row(before, consistent_mass), last = of_row(after, consistent_mass);
  const double slope = (last - first) / (after.edge_mm - before.edge_mm);
  if (edge > after.edge_mm && slope < 0) {
    // Slower and slower, but never backwards: the same slope at first, and a speed that falls to 0.
    const double speed = 100 + last;
    return speed * speed / (speed - slope * (edge - after.edge_mm)) - 100;
  }
  return first + slope * (edge - before.edge_mm);
}

double diffusivity_on_mesh(double edge_mm, double diffusivity_mm2_per_ms, double consistent_mass) {
  // speed(found) (1 + error(found)) = speed(wanted), found step by step: the more diffusive, the less the
  // error.
  constexpr int kSteps = 40;
  double found = diffusivity_mm2_per_ms;
  for (int i = 0; i < kSteps; ++i) {
    const double longest = kMeasured.back().edge_mm * std::sqrt(found / kDiffusivity);
    const double speed =
        1 + wave_speed_error_percent(std::min(edge_mm, longest), found, consistent_mass) / 100;
    found = diffusivity_mm2_per_ms / (speed * speed);
  }
  return found;
}

double edge_for_wave_speed_error(double percent, double diffusivity_mm2_per_ms, double consistent_mass) {
  const auto size = [&](double edge) {
    return std::abs(wave_speed_error_percent(edge, diffusivity_mm2_per_ms, consistent_mass));
  };
  // The first edge length of a fine ladder at which it is more; then halved into.
  const double unit = std::sqrt(diffusivity_mm2_per_ms / kDiffusivity);
  double low = 0, high = 0.01 * unit;
  while (size(high) <= percent && high < 100 * unit) {
    low = high;
    high += 0.01 * unit;
  }
  for (int i = 0; i < 30; ++i) {
    const double middle = (low + high) / 2;
    (size(middle) <= percent ? low : high) = middle;
  }
  return low;
}

}  // namespace voxtet
