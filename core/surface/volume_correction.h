// Restores the volume of every label of a smoothed complex by shifting interfaces along their normals.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "surface/surface_graph.h"
#include "types/surface_mesh.h"

namespace voxtet {

/// One interface a|b moves by delta_ab = lambda_a - lambda_b (lambda of background is 0), the solution of
/// least area-weighted square of: sum over neighbours b of area_ab * delta_ab = missing volume of a. Only
/// surface vertices move; each stays within `max_move` of its place in `start` along every axis. At most
/// three rounds. `points` and `start` are in index space; `orientation` is the sign of the affine's
/// determinant; `target` holds the wanted volume by label, in voxels (entries of labels without triangles are
/// ignored).
void correct_volumes(const SurfaceMesh& surface, const SurfaceGraph& graph, const std::vector<double>& target,
                     double orientation, double max_move, const std::vector<Eigen::Vector3d>& start,
                     std::vector<Eigen::Vector3d>& points);

}  // namespace voxtet
