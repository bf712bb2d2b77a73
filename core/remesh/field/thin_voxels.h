// Voxels of sheets and wires.
#pragma once

#include <cstddef>

#include "remesh/field/label_distances.h"

namespace voxtet::remesh {

/// Whether a voxel inside the grid (not in its two outermost layers) belongs to no block of 2 x 2 x 2 voxels
/// of its label and is not just a bump. A bump has only one neighbour across a face, and this one belongs to
/// a block.
bool is_thin(const LabelVolume& grid, std::size_t voxel);

}  // namespace voxtet::remesh
