// Reports how interpolation changed the labels.
#pragma once

#include "types/label_volume.h"
#include "types/run_context.h"

namespace voxtet::slices {

/// Notes both grids and, for each label, the change of volume, components and Euler number (6-connected, of
/// the voxels) if there is one. Warns of labels whose volume changes by more than 1 % or that fall into more
/// components than before.
void compare_slices(const LabelVolume& before, const LabelVolume& after, const RunContext& ctx);

}  // namespace voxtet::slices
