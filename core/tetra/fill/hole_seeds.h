// Points inside the parts of background that a surface encloses, so that they are left empty.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tetra/mesh/edge_groups.h"
#include "types/surface_mesh.h"

namespace voxtet {

/// One point in background just off each edge-connected part of the boundary between labels and background.
/// Seeds in the background around everything do no harm. The segment from each point to its triangle crosses
/// no other triangle.
std::vector<Eigen::Vector3d> find_hole_seeds(const SurfaceMesh& surface, const EdgeGroups& edges);

}  // namespace voxtet
