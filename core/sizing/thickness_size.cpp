#include "sizing/thickness_size.h"

#include <algorithm>
#include <cmath>

namespace voxtet {
namespace {

/// A thickness range to be mapped; the first and the last percentile of the wall's where none is given.
struct Range {
  double thin_mm, thick_mm;
};

Range range_of(const WallField& wall, const ThicknessSize& rule) {
  if (rule.thin_mm > 0 || rule.thick_mm > 0) return {rule.thin_mm, rule.thick_mm};
  std::vector<float> values;
  for (std::size_t at = 0; at < wall.in_wall.size(); ++at)
    if (wall.in_wall[at] && wall.thickness_mm[at] > 0) values.push_back(wall.thickness_mm[at]);
  if (values.empty()) return {0, 0};
  const auto percentile = [&](std::size_t percent) {
    const auto place = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) * percent / 100);
    std::nth_element(values.begin(), place, values.end());
    return static_cast<double>(*place);
  };
  return {percentile(1), percentile(99)};
}

}  // namespace

void lower_by_thickness(const WallField& wall, const ThicknessSize& rule, const SizingField& grid,
                        std::vector<float>& sizes) {
  const Range range = range_of(wall, rule);
  const auto edge_of = [&](double thickness_mm) {
    if (rule.layers > 0) return thickness_mm / rule.layers;
    const double span = range.thick_mm - range.thin_mm;
    const double share = span > 0 ? std::clamp((thickness_mm - range.thin_mm) / span, 0.0, 1.0) : 0.0;
    return rule.edge_thin_mm + share * (rule.edge_thick_mm - rule.edge_thin_mm);
  };
  const Eigen::Matrix4d to_wall = wall.mm_to_index * grid.index_to_mm;
  grid.visit([&](int i, int j, int k, std::size_t at) {
    const Eigen::Vector4d index = to_wall * Eigen::Vector4d(i, j, k, 1);
    const double thickness = wall.thickness_at_index(index.head<3>());
    if (thickness > 0) sizes[at] = std::min(sizes[at], static_cast<float>(edge_of(thickness)));
  });
}

}  // namespace voxtet
