// What interpolation made of the labels, told to whoever runs it.
#pragma once

#include "types/label_volume.h"
#include "types/run_context.h"

namespace voxtet::slices {

/// Notes both grids and, label by label, the change of volume, components and Euler number (6-connected, of
/// the voxels) where there is one; warns of labels whose volume changes by more than 1 % or that fall into
/// more components than they had.
void compare_slices(const LabelVolume& before, const LabelVolume& after, const RunContext& ctx);

}  // namespace voxtet::slices
