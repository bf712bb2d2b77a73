#include "sizing/curvature_size.h"

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>

#include "geometry/elements/surface_curvature.h"
#include "types/grid_corners.h"

namespace voxtet {
namespace {

constexpr double kTurn = 2 * EIGEN_PI;

/// Whether a point is on the surface of one of the labels; of any label where none are named.
std::vector<bool> points_of(const SurfaceMesh& surface, const std::vector<Label>& labels) {
  std::vector<bool> on(surface.points.size(), labels.empty());
  const auto named = [&](Label label) {
    return std::find(labels.begin(), labels.end(), label) != labels.end();
  };
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (named(surface.sides[t][0]) || named(surface.sides[t][1]))
      for (const std::uint32_t p : surface.triangles[t]) on[p] = true;
  return on;
}

}  // namespace

void lower_by_curvature(const SurfaceMesh& surface, const std::vector<CurvatureSize>& rules, double voxel_mm,
                        SizingField& field) {
  if (rules.empty()) return;
  const std::vector<float> curvature = surface_curvature(surface, kCurvatureWidthVoxels * voxel_mm);
  for (const CurvatureSize& rule : rules) {
    // The mean around each grid point, since a minimum would pick out what is left of the staircase.
    std::vector<float> sum(field.h_mm.size(), 0.F), weights(field.h_mm.size(), 0.F);
    const std::vector<bool> counts = points_of(surface, rule.labels);
    for (std::size_t p = 0; p < surface.points.size(); ++p) {
      if (!counts[p]) continue;
      for_grid_corners(field.size, field.to_index(surface.points[p]), [&](std::size_t at, double weight) {
        sum[at] += static_cast<float>(weight * curvature[p]);
        weights[at] += static_cast<float>(weight);
      });
    }
    for (std::size_t at = 0; at < sum.size(); ++at) {
      if (!(sum[at] > 0)) continue;
      const double edge = kTurn * weights[at] / (rule.edges_per_turn * sum[at]);
      field.h_mm[at] = std::min(field.h_mm[at], static_cast<float>(std::max(edge, rule.edge_min_mm)));
    }
  }
}

}  // namespace voxtet
