// The inner spaces of a wall, found when only the wall itself is labelled.
#pragma once

#include "walls/wall_grid.h"

namespace voxtet::wall {

/// Turns cavities, which are kOuter so far, into inner spaces and returns their number; the largest come
/// first. If there are cavities that the wall encloses on all sides, these are taken. Else the wall is a cup,
/// or two, cut open by a plane: the direction is sought for which most of the background lies in holes of the
/// planes across it (as a ventricle's cavity does in short-axis slices). Cavities smaller than a tenth of the
/// largest do not count. A single cavity that falls into large parts at some distance from the wall is split
/// in two, as for ventricles whose septum ends below the base.
std::size_t find_cavities(WallGrid& grid);

}  // namespace voxtet::wall
