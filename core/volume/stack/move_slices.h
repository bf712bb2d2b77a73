// Moves slices in their plane.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "volume/stack/slice_stack.h"

namespace voxtet::slices {

/// Moves each slice's labels by `moves_mm` (one a slice); background comes in. What a move has beyond whole
/// pixels is made by the labels' signed distances within the slice, unless that would tear or join labels,
/// bring others together, or change a label's area by more than a twentieth and two pixels: such a slice is
/// moved by whole pixels. `moves_mm` becomes what was done. Labels that would leave the slice are lost: give
/// it room before.
SliceStack move_slices(const SliceStack& stack, std::vector<Eigen::Vector2d>& moves_mm);

/// How much of two neighbouring slices is the same: 2 |equal labels| / (|labels of one| + |of the other|), 1
/// for two without labels.
double overlap(const SliceStack& stack, int lower);

}  // namespace voxtet::slices
