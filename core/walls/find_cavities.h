// The inner spaces of a wall of which only the wall itself is labelled.
#pragma once

#include "walls/wall_grid.h"

namespace voxtet::wall {

/// Turns cavities, which are kOuter so far, into inner spaces and returns their number; the largest come
/// first. Cavities that the wall encloses on all sides are taken if there are any; else the wall is a cup, or
/// two, cut open by a plane: the direction is sought in which most of the background lies in holes of the
/// planes across it (as a ventricle's cavity does in short-axis slices). Cavities of less than a tenth of the
/// largest are none; one that falls into large parts some way off the wall is parted, as two ventricles are
/// whose septum ends below the base.
std::size_t find_cavities(WallGrid& grid);

}  // namespace voxtet::wall
