// The rim of an open base: neither inner nor outer surface.
#pragma once

#include "walls/wall_grid.h"

namespace voxtet::wall {

/// Finds where inner spaces are open, that is where their voxels touch voxels of kOuter: the valve planes of
/// a ventricle. The plane of an opening goes through the mean of its faces, across their mean normal. Outer
/// voxels on the wall become kSide if they lie in this plane (from a quarter of a voxel below it to two
/// voxels above) and are connected to the opening through such voxels. Openings of fewer than 30 faces are
/// taken for holes in the wall, and change nothing. Returns the number of openings.
int mark_base(WallGrid& grid);

}  // namespace voxtet::wall
