// First points on every interface and junction, so that the refinement finds all of them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "remesh/field/label_field.h"
#include "types/run_context.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"

namespace voxtet::remesh {

struct Seeds {
  std::vector<Eigen::Vector3d> points;  ///< mm, on junctions, then on interfaces
  double predicted_vertices = 0;        ///< rough size of the finished surface, for progress
};

inline constexpr double kSeedSpacing = 2.5;  ///< spacing of the seeds of one interface, in target edge
                                             ///< lengths
inline constexpr std::size_t kSeedsOfInterface = 8;  ///< least number, where the lattice offers as many

/// Points along the junctions of `reference` (the smoothed label surface), then Poisson-spaced ones on the
/// interface of every pair of touching 6-connected components. All are at least half an edge length apart,
/// because facets around a short edge become as small; seeds of pairs that would get too few may be closer.
/// Fixed order. Once `ctx` is cancelled, fewer.
Seeds seed_interfaces(const LabelField& field, const SurfaceMesh& reference, const SizingField& sizing,
                      const RunContext& ctx);

/// Only the Poisson-spaced points, `spacing` target edge lengths apart, and only between these pairs of
/// labels of the volume (ascending, the higher label of each pair first).
std::vector<Eigen::Vector3d> seed_between(const LabelField& field, const SizingField& sizing, double spacing,
                                          const std::vector<Sides>& between, const RunContext& ctx);

}  // namespace voxtet::remesh
