// Moves a deformed complex back towards its start where it intersects itself.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "types/run_context.h"
#include "types/surface_mesh.h"

namespace voxtet {

struct UndoOutcome {
  std::size_t moved_back = 0;  ///< points that are not where they were asked to be
  int rounds = 0;              ///< number of rounds that moved points back
  bool cancelled = false;      ///< the surface then still has intersections
};

/// On return the triangles of `surface` do not intersect each other, provided that they do not with all
/// points at `start`. Where they would, the corners of these triangles are moved halfway back to their start,
/// in later rounds with a growing neighbourhood, at last all the way: each point stays on the segment from
/// its start to where it was. Exact (self_intersections.h), deterministic. A round examines only triangles
/// with a corner that moved in the round before, the first round those with a corner away from its start.
/// Needs a start for every point, valid indices and triangles with an area.
UndoOutcome undo_intersections(SurfaceMesh& surface, const std::vector<Eigen::Vector3d>& start,
                               const RunContext& ctx);

}  // namespace voxtet
