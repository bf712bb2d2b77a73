// First points on every interface and junction, so that the refinement finds all of them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "remesh/field/label_field.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"

namespace voxtet::remesh {

struct Seeds {
  std::vector<Eigen::Vector3d> points;  ///< mm, on junctions, then on interfaces
  double predicted_vertices = 0;        ///< rough size of the finished surface, for progress
};

inline constexpr double kSeedSpacing = 2.5;          ///< of one interface's seeds, in target edge lengths
inline constexpr std::size_t kSeedsOfInterface = 8;  ///< at least, where the lattice offers as many

/// Points along the junctions of `reference` (the smoothed label surface), then Poisson-spaced ones on the
/// interface of every pair of touching 6-connected components. All keep half an edge length apart, because
/// facets around a short edge become as small; those of pairs that would get too few come closer. Fixed
/// order.
Seeds seed_interfaces(const LabelField& field, const SurfaceMesh& reference, const SizingField& sizing);

/// Poisson-spaced points alone, `spacing` target edge lengths apart, and only between these labels of the
/// volume (ascending, the higher label of each pair first).
std::vector<Eigen::Vector3d> seed_between(const LabelField& field, const SizingField& sizing, double spacing,
                                          const std::vector<Sides>& between);

}  // namespace voxtet::remesh
