// The distribution of one measure.
#pragma once

#include <string>
#include <vector>

#include "types/quality_report.h"

namespace voxtet {

/// How a measure is described and binned.
struct MetricInfo {
  std::string name, unit, elements;
  double lo = 0, hi = 1;  ///< of the histogram
  enum class Worst { kNone, kLowest, kHighest } worst = Worst::kNone;
  std::string title{};  ///< for people; empty: viewers have their own name for it
};

/// Extremes, quantiles (nearest rank), mean, standard deviation, histogram, and up to 100 worst ids (ties by
/// id). Infinite values count in quantiles and histogram but not in mean and deviation; NaN counts nowhere.
/// No values: all zero.
MetricSummary summarise(const MetricInfo& info, const std::vector<float>& values, int bins);

/// The value below which a fraction q of the values lies (nearest rank). Reorders the values; 0 when there
/// are none.
double quantile(std::vector<float>& values, double q);

}  // namespace voxtet
