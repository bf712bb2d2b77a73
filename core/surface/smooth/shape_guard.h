// What smoothing may not do to a triangle: collapse it, turn it over, or move it across a voxel centre.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/repair/retreat.h"
#include "surface/smooth/voxel_regions.h"
#include "types/run_context.h"
#include "types/surface_mesh.h"

namespace voxtet {

/// Moves points back towards `safe` until every triangle
/// - keeps a fiftieth of its area, projected along its normal at the start, and
/// - has no held voxel centre within a twentieth of a voxel of the convex hull of its corners at the start
///   and now, proven in floating point (half_space.h).
/// Held are the voxels deeper than half a voxel inside their region (no neighbour of another region), and
/// those of structures one voxel thick (both neighbours along some axis are of other regions). All others are
/// voxels at the surface of something thicker. The winding number of a closed surface about a point changes
/// only when the surface passes the point. No triangle passes a held centre on the straight line from start
/// to now, so each such centre stays on its side of every label. Steps back towards the start do not break
/// the second condition. All triangles must meet both conditions with all points at `safe`; an extracted
/// surface does at its start. All points are in index space. Returns flags of the points that were moved
/// back.
Flags guard_shape(const std::vector<Triangle>& triangles, const VoxelRegions& regions,
                  const std::vector<Eigen::Vector3d>& start, const std::vector<Eigen::Vector3d>& safe,
                  std::vector<Eigen::Vector3d>& points, const RunContext& ctx);

}  // namespace voxtet
