#include "physics/monodomain/activation_log.h"

#include <limits>

namespace voxtet {
namespace {

constexpr float kNever = std::numeric_limits<float>::quiet_NaN();

float crossing(double begin_ms, double step_ms, double before, double after, double level) {
  return static_cast<float>(begin_ms + step_ms * (level - before) / (after - before));
}

}  // namespace

void ActivationLog::record(double begin_ms, double step_ms, const Eigen::VectorXd& before,
                           const Eigen::VectorXd& after, const fem::RowRanges& rows) {
  for (const auto [first, last] : rows)
    for (int i = first; i < last; ++i) {
      const double from = before[i], to = after[i];
      const auto point = static_cast<std::uint32_t>(i);
      if (from < kActivated && to >= kActivated)
        activations_.push_back({point, crossing(begin_ms, step_ms, from, to, kActivated)});
      else if (from > kRepolarised && to <= kRepolarised)
        repolarisations_.push_back({point, crossing(begin_ms, step_ms, from, to, kRepolarised)});
    }
}

std::vector<ActivationLog::Beat> ActivationLog::beats(std::size_t points, std::size_t most) const {
  const std::vector<float> none(points, kNever);
  std::vector<Beat> beats{{none, none}};
  std::vector<std::size_t> count(points, 0);
  for (const Crossing& found : activations_) {
    const std::size_t k = count[found.point]++;
    if (k >= most) continue;
    if (k == beats.size()) beats.push_back({none, none});
    beats[k].activated_ms[found.point] = found.time_ms;
  }
  std::vector<std::size_t> repolarised(points, 0);
  for (const Crossing& found : repolarisations_)
    for (std::size_t& k = repolarised[found.point];
         k < beats.size() && found.time_ms > beats[k].activated_ms[found.point]; ++k)
      beats[k].repolarised_ms[found.point] = found.time_ms;
  return beats;
}

std::vector<float> ActivationLog::last_activation(std::size_t points) const {
  std::vector<float> times(points, kNever);
  for (const Crossing& found : activations_) times[found.point] = found.time_ms;
  return times;
}

std::vector<float> ActivationLog::activation_counts(std::size_t points) const {
  std::vector<float> counts(points, 0);
  for (const Crossing& found : activations_) ++counts[found.point];
  return counts;
}

}  // namespace voxtet
