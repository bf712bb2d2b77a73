// What smoothing may not do to a triangle: collapse, turn over, or pass a voxel centre.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/retreat.h"
#include "types/run_context.h"
#include "types/surface_mesh.h"

namespace voxtet {

/// Moves points back towards `start` (both in index space) until every triangle
/// - keeps a fiftieth of its area, measured across its normal at the start, and
/// - has no voxel centre (no point of integer coordinates) in the convex hull of its corners at the start and
///   now, proven in floating point (half_space.h).
/// The winding number of a closed surface about a point changes only when the surface passes the point; on
/// the straight way from start to now no triangle passes a voxel centre, so every centre stays on the side of
/// every label where it was. The second condition survives further steps back on the same segments. All
/// triangles at the start of an extracted surface meet both. Returns the points that went back as flags.
Flags guard_shape(const std::vector<Triangle>& triangles, const std::vector<Eigen::Vector3d>& start,
                  std::vector<Eigen::Vector3d>& points, const RunContext& ctx);

}  // namespace voxtet
