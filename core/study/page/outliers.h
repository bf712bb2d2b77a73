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

/// A value beyond the outer fences of its column: farther from the quartiles than three times the distance
/// between them (Tukey 1977).
struct Outlier {
  std::size_t row = 0;
  std::string column;
  double value = 0, median = 0;
  double beyond = 0;  ///< distance from the nearer quartile, in distances between the quartiles; infinite if
                      ///< these are one
};

/// Of some columns, the farthest first. Quartiles are the
/// values at n/4 and 3n/4 of n, rounded down, counted from 0 in ascending order.
std::vector<Outlier> find_outliers(const std::vector<nlohmann::ordered_json>& rows,
                                   const std::vector<std::string>& columns);

}  // namespace voxtet
