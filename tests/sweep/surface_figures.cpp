#include "sweep/surface_figures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "geometry/elements/triangle_measures.h"
#include "geometry/intersect/exact_intersections.h"
#include "geometry/topology/compare_topology.h"
#include "geometry/topology/label_topology.h"
#include "quality/summarise.h"
#include "quality/surface_distance.h"
#include "sweep/defects.h"
#include "tetra/fill/check_surface.h"

namespace voxtet::sweep {
namespace {

std::string number(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

void measure_triangles(const SurfaceMesh& surface, SurfaceFigures& out) {
  out.min_angle_deg = 180;
  std::size_t below = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    const TriangleShape shape = measure_triangle({surface.points[a], surface.points[b], surface.points[c]});
    out.min_angle_deg = std::min(out.min_angle_deg, shape.min_angle_deg);
    out.mean_radius_ratio += shape.radius_ratio;
    below += shape.min_angle_deg < 25 ? 1 : 0;
  }
  const auto count = static_cast<double>(surface.triangles.size());
  out.triangles = surface.triangles.size();
  out.mean_radius_ratio /= count;
  out.share_below_25 = static_cast<double>(below) / count;
}

void measure_edges(const SurfaceMesh& surface, const SizingField& sizing, SurfaceFigures& out) {
  const EdgeGroups edges(surface);
  out.min_dihedral_deg = find_sharpest_edge(surface, edges).angle_deg;
  std::vector<float> logs, absolute;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const Eigen::Vector3d &a = surface.points[edges[e][0].low], &b = surface.points[edges[e][0].high];
    logs.push_back(static_cast<float>(std::log2((b - a).norm() / sizing.at((a + b) / 2))));
    absolute.push_back(std::abs(logs.back()));
  }
  out.size_median = quantile(logs, 0.5);
  out.size_p95 = quantile(absolute, 0.95);
}

void compare_ledgers(const Session& session, SurfaceFigures& out) {
  for (const TopologyDifference& difference :
       compare_topology(label_topology(*session.surface()), label_topology(*session.remeshed()))) {
    const std::string text = in_words(difference);
    out.ledger_differences.push_back(text);
    const bool named = (difference.label != kBackground && names_label(session, difference.label)) ||
                       (difference.other != kBackground && names_label(session, difference.other));
    if (!named) out.unnamed_differences.push_back(text);
  }
}

}  // namespace

SurfaceFigures measure_surface(const Session& session) {
  SurfaceFigures out;
  const SurfaceMesh &adapted = *session.remeshed(), &labels = *session.smooth();
  out.smooth_intersections = count_self_intersections(labels);
  out.intersections = count_self_intersections(adapted);
  measure_triangles(adapted, out);
  measure_edges(adapted, *session.sizing(), out);
  const double voxel = session.volume()->smallest_spacing_mm();
  RunContext ctx;
  const SurfaceDistances distances =
      measure_distances({adapted.points, adapted.triangles, adapted.sides},
                        {labels.points, labels.triangles, labels.sides}, {voxel / 4, voxel / 20}, ctx)
          .value();
  const DistanceSummary &there = distances.forth, &back = distances.back;
  out.mean_distance = there.mean_mm / voxel;
  out.max_distance = there.max_mm / voxel;
  out.mean_back = back.mean_mm / voxel;
  out.max_back = back.max_mm / voxel;
  out.uncertainty = std::max(there.uncertainty_mm, back.uncertainty_mm) / voxel;
  compare_ledgers(session, out);
  return out;
}

SurfaceLimits limits_of(const std::string& method) {
  if (method == "adapt") return {0.07, 1, 18, 0.005, 0.955};
  return {0.05, 0.5, 29, 1, 0};
}

std::vector<std::string> check_intersections_and_topology(const SurfaceFigures& figures) {
  std::vector<std::string> failures;
  if (figures.smooth_intersections)
    failures.push_back(std::to_string(figures.smooth_intersections) +
                       " self-intersections of the smoothed surface");
  if (figures.intersections)
    failures.push_back(std::to_string(figures.intersections) + " self-intersections of the adapted surface");
  for (const std::string& text : figures.unnamed_differences) failures.push_back("not reported: " + text);
  return failures;
}

std::vector<std::string> check_dihedral(const SurfaceFigures& figures, double least_deg) {
  if (figures.min_dihedral_deg >= least_deg) return {};
  return {"facets meet at " + number(figures.min_dihedral_deg, 1) + " degrees, expected " +
          number(least_deg, 0)};
}

std::vector<std::string> check_distances(const SurfaceFigures& figures, const SurfaceLimits& limits) {
  std::vector<std::string> failures;
  const double mean = std::max(figures.mean_distance, figures.mean_back);
  const double most = std::max(figures.max_distance, figures.max_back);
  if (!(mean <= limits.mean_distance))
    failures.push_back("mean distance " + number(mean, 3) + " voxel, expected " +
                       number(limits.mean_distance, 2));
  if (!(most <= limits.max_distance))
    failures.push_back("distance " + number(most, 2) + " voxel, expected " + number(limits.max_distance, 1));
  return failures;
}

std::vector<std::string> check_shape_and_size(const SurfaceFigures& figures, const SurfaceLimits& limits) {
  std::vector<std::string> failures;
  if (!(figures.min_angle_deg >= limits.min_angle_deg))
    failures.push_back("smallest angle " + number(figures.min_angle_deg, 1) + " degrees, expected " +
                       number(limits.min_angle_deg, 0));
  if (!(figures.share_below_25 <= limits.share_below_25))
    failures.push_back(number(100 * figures.share_below_25, 2) + " % of the triangles below 25 degrees");
  if (!(figures.mean_radius_ratio >= limits.mean_radius_ratio))
    failures.push_back("mean radius ratio " + number(figures.mean_radius_ratio, 3) + ", expected " +
                       number(limits.mean_radius_ratio, 3));
  if (!(std::abs(figures.size_median) <= 0.05))
    failures.push_back("median log2 l/h " + number(figures.size_median, 3) + ", expected within 0.05");
  if (!(figures.size_p95 <= 0.5))
    failures.push_back("p95 of |log2 l/h| " + number(figures.size_p95, 2) + ", expected 0.5");
  return failures;
}

nlohmann::json figures_json(const SurfaceFigures& f) {
  return {{"triangles", f.triangles},
          {"smooth_intersections", f.smooth_intersections},
          {"intersections", f.intersections},
          {"mean_distance_voxels", f.mean_distance},
          {"max_distance_voxels", f.max_distance},
          {"mean_back_voxels", f.mean_back},
          {"max_back_voxels", f.max_back},
          {"uncertainty_voxels", f.uncertainty},
          {"min_angle_deg", f.min_angle_deg},
          {"share_below_25", f.share_below_25},
          {"mean_radius_ratio", f.mean_radius_ratio},
          {"min_dihedral_deg", f.min_dihedral_deg},
          {"size_median", f.size_median},
          {"size_p95", f.size_p95},
          {"ledger_differences", f.ledger_differences},
          {"unnamed_differences", f.unnamed_differences}};
}

void print_figures_heading() {
  std::printf(
      "| case | triangles | intersections: smoothed, adapted | distance mean/max | back mean/max | "
      "smallest angle | below 25 deg %% | 2r/R | facet dihedral | log2 l/h median/p95 | ledger differences, "
      "unnamed | failures |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
}

void print_figures(const std::string& name, const SurfaceFigures& f, std::size_t failures) {
  std::printf(
      "| %s | %zu | %zu, %zu | %.3f/%.2f | %.3f/%.2f | %.1f | %.2f | %.3f | %.1f | %+.3f/%.2f | %zu, %zu | "
      "%zu |\n",
      name.c_str(), f.triangles, f.smooth_intersections, f.intersections, f.mean_distance, f.max_distance,
      f.mean_back, f.max_back, f.min_angle_deg, 100 * f.share_below_25, f.mean_radius_ratio,
      f.min_dihedral_deg, f.size_median, f.size_p95, f.ledger_differences.size(),
      f.unnamed_differences.size(), failures);
  std::fflush(stdout);
}

}  // namespace voxtet::sweep
