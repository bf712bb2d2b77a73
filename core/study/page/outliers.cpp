#include "study/page/outliers.h"

#include <algorithm>

namespace voxtet {
namespace {

/// The smallest value with a part of all below it; `values` is ascending and not empty.
double at_part(const std::vector<double>& values, std::size_t quarters) {
  return values[std::min(values.size() - 1, values.size() * quarters / 4)];
}

}  // namespace

std::vector<std::optional<double>> numbers_of(const std::vector<nlohmann::ordered_json>& rows,
                                              const std::string& column) {
  std::vector<std::optional<double>> numbers;
  numbers.reserve(rows.size());
  for (const nlohmann::ordered_json& row : rows)
    numbers.push_back(row.contains(column) && row[column].is_number()
                          ? std::optional(row[column].get<double>())
                          : std::nullopt);
  return numbers;
}

std::vector<Outlier> find_outliers(const std::vector<nlohmann::ordered_json>& rows,
                                   const std::vector<std::string>& columns) {
  constexpr double kFence = 3;
  std::vector<Outlier> found;
  for (const std::string& column : columns) {
    const std::vector<std::optional<double>> numbers = numbers_of(rows, column);
    std::vector<double> values;
    for (const std::optional<double>& number : numbers)
      if (number) values.push_back(*number);
    if (values.empty()) continue;
    std::sort(values.begin(), values.end());
    const double low = at_part(values, 1), median = at_part(values, 2), high = at_part(values, 3);
    for (std::size_t row = 0; row < numbers.size(); ++row) {
      if (!numbers[row]) continue;
      const double beyond = std::max(low - *numbers[row], *numbers[row] - high);
      if (beyond > kFence * (high - low))
        found.push_back({row, column, *numbers[row], median, beyond / (high - low)});
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Outlier& a, const Outlier& b) { return a.beyond > b.beyond; });
  return found;
}

}  // namespace voxtet
