// Voxels of sheets and wires.
#pragma once

#include <cstddef>

#include "remesh/field/label_distances.h"

namespace voxtet::remesh {

/// Whether a voxel inside the grid (not in its two outermost layers) belongs to no block of 2 x 2 x 2 voxels
/// of its label and is no mere bump: a bump's only neighbour across a face does belong to a block.
bool is_thin(const LabelVolume& grid, std::size_t voxel);

}  // namespace voxtet::remesh
