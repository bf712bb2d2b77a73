// First points on every interface and junction, so that the refinement finds all of them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "remesh/label_field.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"

namespace voxtet::remesh {

struct Seeds {
  std::vector<Eigen::Vector3d> points;  ///< mm, on junctions, then on interfaces
  double predicted_vertices = 0;        ///< rough size of the finished surface, for progress
};

/// Points along the junctions of `reference` (the smoothed label surface), then Poisson-spaced ones
/// (kSeedSpacing wished edge lengths apart) on the interface of every pair of touching 6-connected
/// components, at least eight each where the lattice offers as many. All keep half an edge length apart,
/// because facets around a short edge become as small; those of pairs that would get too few come closer.
/// Fixed order.
Seeds seed_interfaces(const LabelField& field, const SurfaceMesh& reference, const SizingField& sizing);

inline constexpr double kSeedSpacing = 2.5;

}  // namespace voxtet::remesh
