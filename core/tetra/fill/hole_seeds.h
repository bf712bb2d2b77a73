// Points inside the parts of background that a surface encloses, so that they are left empty.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tetra/mesh/edge_groups.h"
#include "types/surface_mesh.h"

namespace voxtet {

/// One point in background just off each edge-connected part of the boundary between labels and background.
/// Where the background is outside of everything the point does no harm. Each point's way to its triangle
/// crosses no other triangle.
std::vector<Eigen::Vector3d> find_hole_seeds(const SurfaceMesh& surface, const EdgeGroups& edges);

}  // namespace voxtet
