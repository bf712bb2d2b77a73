// Moves a deformed complex back towards its start where it intersects itself.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "types/run_context.h"
#include "types/surface_mesh.h"

namespace voxtet {

struct UndoOutcome {
  std::size_t moved_back = 0;  ///< points that do not stand where they were asked to
  int rounds = 0;              ///< in which some points went back
  bool cancelled = false;      ///< the surface is then still tangled
};

/// On return the triangles of `surface` do not intersect each other, provided that they did not with all
/// points at `start`. Where they would, the corners of the triangles concerned go halfway back to their
/// start, in later rounds with a growing neighbourhood, at last all the way: each point stays on the segment
/// from its start to where it was. Exact (self_intersections.h), deterministic; a round looks only at
/// triangles with a corner that moved in the round before, the first one at those with a corner away from
/// its start. Needs a start for every point, valid indices and triangles with an area.
UndoOutcome undo_intersections(SurfaceMesh& surface, const std::vector<Eigen::Vector3d>& start,
                               const RunContext& ctx);

}  // namespace voxtet
