// Clamped bi-Laplacian smoothing of displacements.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "surface/move_limits.h"
#include "surface/surface_graph.h"
#include "types/run_context.h"

namespace voxtet {

/// `iterations` times x <- clamp(x - step * L(L(x))), where L(x) is the mean of a vertex's neighbours minus
/// itself (0 at fixed vertices, which stay) and the clamp is that of `limits` around `start`. Displacements
/// are held in single precision. Identical for any ctx.threads. Returns the points, or nothing when
/// cancelled.
std::vector<Eigen::Vector3d> smooth_bilaplacian(const SurfaceGraph& graph,
                                                const std::vector<Eigen::Vector3d>& start,
                                                const MoveLimits& limits, int iterations, double step,
                                                const RunContext& ctx);

}  // namespace voxtet
