// Plots as SVG, for pages.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace voxtet {

/// Round numbers from at most `low` to at least `high`, two to seven steps apart, each step no less than
/// `least`.
std::vector<double> round_ticks(double low, double high, double least = 0);

/// How many values lie where. `values` is not empty.
std::string histogram_svg(const std::string& title, const std::vector<double>& values);

struct PlotPoint {
  double x = 0, y = 0;
  std::string title;  ///< shown under the pointer
  bool marked = false;
};

/// One value against another. With `diagonal` the line y = x. `points` is not empty.
std::string scatter_svg(const std::string& title, const std::string& x_title, const std::string& y_title,
                        const std::vector<PlotPoint>& points, bool diagonal);

}  // namespace voxtet
