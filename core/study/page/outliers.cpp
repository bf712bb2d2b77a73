#include "study/page/outliers.h"

#include <algorithm>
#include <cmath>

namespace voxtet {
namespace {

/// The middle value, or the mean of both; `values` is not empty.
double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

}  // namespace

std::vector<std::optional<double>> numbers_of(const std::vector<nlohmann::ordered_json>& rows,
                                              const std::string& column) {
  std::vector<std::optional<double>> numbers;
  for (const nlohmann::ordered_json& row : rows)
    numbers.push_back(row.contains(column) && row[column].is_number()
                          ? std::optional(row[column].get<double>())
                          : std::nullopt);
  return numbers;
}

std::vector<Outlier> find_outliers(const std::vector<nlohmann::ordered_json>& rows,
                                   const std::vector<std::string>& columns) {
  constexpr double kMostDeviations = 3;
  std::vector<Outlier> found;
  for (const std::string& column : columns) {
    const std::vector<std::optional<double>> numbers = numbers_of(rows, column);
    std::vector<double> values, distances;
    for (const std::optional<double>& number : numbers)
      if (number) values.push_back(*number);
    if (values.empty()) continue;
    const double median = median_of(values);
    for (const double value : values) distances.push_back(std::abs(value - median));
    const double deviation = 1.4826 * median_of(distances);
    if (!(deviation > 0)) continue;
    for (std::size_t row = 0; row < numbers.size(); ++row)
      if (numbers[row] && std::abs(*numbers[row] - median) > kMostDeviations * deviation)
        found.push_back({row, column, *numbers[row], median, std::abs(*numbers[row] - median) / deviation});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Outlier& a, const Outlier& b) { return a.deviations > b.deviations; });
  return found;
}

}  // namespace voxtet
