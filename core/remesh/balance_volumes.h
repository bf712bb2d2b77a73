// Gives every label its voxel volume back, which smoothing takes from thin and convex labels.
#pragma once

#include "remesh/label_field.h"
#include "remesh/smooth_labels.h"

namespace voxtet::remesh {

/// Adds one constant to all weights of each label (background's is 0), such that the volume where the label
/// wins equals its number of voxels. Volumes are estimated from the linear part of the lead over the best
/// rival in each eighth of a cell; a few Newton steps, each label on its own, the constants bounded by a
/// quarter of an indicator (about a fifth of a voxel at the default smoothing). The rounded constants decide,
/// not their last bits.
void balance_volumes(const LabelGrid& grid, VoxelWeights& weights);

}  // namespace voxtet::remesh
