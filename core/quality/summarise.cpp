#include "quality/summarise.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <utility>

namespace voxtet {
namespace {

constexpr std::size_t kWorstCount = 100;

std::size_t rank_of(double q, std::size_t count) {
  const double rank = std::ceil(q * static_cast<double>(count)) - 1;
  return static_cast<std::size_t>(std::clamp(rank, 0.0, static_cast<double>(count - 1)));
}

/// The values of given ranks among many: counts by the upper half of the bits, then orders only the values of
/// the bucket that holds the rank.
class Ranking {
 public:
  explicit Ranking(const std::vector<float>& values) : values_(values), ends_(65536, 0) {
    for (const float value : values) ++ends_[bucket_of(value)];
    for (std::size_t i = 1; i < ends_.size(); ++i) ends_[i] += ends_[i - 1];
  }
  /// `rank` below the number of values.
  float at(std::size_t rank) const {
    const auto bucket =
        static_cast<std::size_t>(std::upper_bound(ends_.begin(), ends_.end(), rank) - ends_.begin());
    std::vector<float> within;
    for (const float value : values_)
      if (bucket_of(value) == bucket) within.push_back(value);
    const std::size_t before = bucket == 0 ? 0 : ends_[bucket - 1];
    const auto place = within.begin() + static_cast<std::ptrdiff_t>(rank - before);
    std::nth_element(within.begin(), place, within.end());
    return *place;
  }

 private:
  /// Grows with the value: of an IEEE float the bits do, once those of negative ones are turned around.
  static std::size_t bucket_of(float value) {
    value += 0.F;  // -0 as 0
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    return (bits >> 31 ? ~bits : bits | 0x80000000U) >> 16;
  }

  const std::vector<float>& values_;
  std::vector<std::size_t> ends_;  ///< of each bucket among the values in order
};

Histogram histogram_of(const MetricInfo& info, const std::vector<float>& values, int bins) {
  Histogram histogram{info.lo, info.hi, std::vector<std::uint64_t>(static_cast<std::size_t>(bins), 0)};
  const double scale = bins / (info.hi - info.lo);
  for (const float value : values) {
    const double bin = std::clamp((value - info.lo) * scale, 0.0, static_cast<double>(bins - 1));
    ++histogram.counts[static_cast<std::size_t>(bin)];
  }
  return histogram;
}

std::vector<std::uint32_t> worst_of(const MetricInfo& info, const std::vector<float>& values) {
  if (info.worst == MetricInfo::Worst::kNone) return {};
  const float sign = info.worst == MetricInfo::Worst::kLowest ? 1.F : -1.F;
  std::vector<std::uint32_t> ids;
  ids.reserve(values.size());
  for (std::uint32_t i = 0; i < values.size(); ++i)
    if (!std::isnan(values[i])) ids.push_back(i);
  const std::size_t count = std::min(kWorstCount, ids.size());
  std::partial_sort(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(count), ids.end(),
                    [&](std::uint32_t a, std::uint32_t b) {
                      return values[a] != values[b] ? sign * values[a] < sign * values[b] : a < b;
                    });
  ids.resize(count);
  return ids;
}

}  // namespace

double quantile(std::vector<float>& values, double q) {
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank_of(q, values.size()));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

MetricSummary summarise(const MetricInfo& info, const std::vector<float>& values, int bins) {
  MetricSummary out;
  out.name = info.name;
  out.title = info.title;
  out.unit = info.unit;
  out.elements = info.elements;
  std::vector<float> numbers;
  numbers.reserve(values.size());
  std::copy_if(values.begin(), values.end(), std::back_inserter(numbers),
               [](float v) { return !std::isnan(v); });
  out.count = numbers.size();
  out.histogram = histogram_of(info, numbers, bins);
  if (numbers.empty()) return out;
  out.worst = worst_of(info, values);
  double sum = 0, squares = 0;
  std::size_t finite = 0;
  for (const float value : numbers) {
    if (!std::isfinite(value)) continue;
    sum += value;
    squares += static_cast<double>(value) * value;
    ++finite;
  }
  if (finite > 0) {
    out.mean = sum / static_cast<double>(finite);
    out.sd = std::sqrt(std::max(0.0, squares / static_cast<double>(finite) - out.mean * out.mean));
  }
  const Ranking ranking(numbers);
  for (const auto& [q, target] : {std::pair{0.0, &out.min},
                                  {0.001, &out.p01},
                                  {0.01, &out.p1},
                                  {0.05, &out.p5},
                                  {0.5, &out.median},
                                  {0.95, &out.p95},
                                  {0.99, &out.p99},
                                  {1.0, &out.max}})
    *target = ranking.at(rank_of(q, numbers.size()));
  return out;
}

}  // namespace voxtet
