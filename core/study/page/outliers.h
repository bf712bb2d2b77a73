// Values that lie far from the rest of their column.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace voxtet {

/// The numbers of a column, in the order of the rows; nullopt where a row has none.
std::vector<std::optional<double>> numbers_of(const std::vector<nlohmann::ordered_json>& rows,
                                              const std::string& column);

/// A value that is farther from the median of its column than three robust standard deviations (1.4826 times
/// the median of the distances from the median; Leys et al. 2013).
struct Outlier {
  std::size_t row = 0;
  std::string column;
  double value = 0, median = 0, deviations = 0;
};

/// Of some columns, the farthest first. A column of which half the values are one has none.
std::vector<Outlier> find_outliers(const std::vector<nlohmann::ordered_json>& rows,
                                   const std::vector<std::string>& columns);

}  // namespace voxtet
