// The adapted surface of a case in figures, and the limits they are held to.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pipeline/session.h"

namespace voxtet::sweep {

/// Distances in voxels (smallest spacing) between the adapted surface and the smoothed label surface, by
/// samples a quarter of a voxel apart: nothing is farther than max + uncertainty.
struct SurfaceFigures {
  std::size_t triangles = 0;
  std::size_t smooth_intersections = 0, intersections = 0;  ///< pairs, by exact_intersections.h
  double mean_distance = 0, max_distance = 0;               ///< adapted surface to label surface
  double mean_back = 0, max_back = 0, uncertainty = 0;      ///< and the way back
  double min_angle_deg = 0, share_below_25 = 0, mean_radius_ratio = 0;
  double min_dihedral_deg = 0;                   ///< between any two triangles with a common edge
  double size_median = 0, size_p95 = 0;          ///< log2(l / h) over the edges; p95 of its absolute value
  std::vector<std::string> ledger_differences;   ///< between the voxels' surface and the adapted one
  std::vector<std::string> unnamed_differences;  ///< those that no warning or note speaks of
};

/// Needs a session that has run kSmooth and kRemesh.
SurfaceFigures measure_surface(const Session& session);

struct SurfaceLimits {
  double mean_distance, max_distance;
  double min_angle_deg, share_below_25, mean_radius_ratio;
};
/// Of the method's name; those of `delaunay` for any other name than `adapt`.
SurfaceLimits limits_of(const std::string& method);

/// Everything that is beyond a limit, in words.
std::vector<std::string> check_intersections_and_topology(const SurfaceFigures& figures);
std::vector<std::string> check_dihedral(const SurfaceFigures& figures, double least_deg);
std::vector<std::string> check_distances(const SurfaceFigures& figures, const SurfaceLimits& limits);
std::vector<std::string> check_shape_and_size(const SurfaceFigures& figures, const SurfaceLimits& limits);

nlohmann::json figures_json(const SurfaceFigures& figures);

/// One row of the table below this heading, for the case described by `name`.
void print_figures_heading();
void print_figures(const std::string& name, const SurfaceFigures& figures, std::size_t failures);

}  // namespace voxtet::sweep
