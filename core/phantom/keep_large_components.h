// Removes what sampling cuts off from a body.
#pragma once

#include "types/label_volume.h"

namespace voxtet {

/// Gives every 6-connected component of a label (not of background) that is smaller than `share` of the
/// label's largest component the commonest other label among its face neighbours (the lower one of equals),
/// until there is none left. Linear time a pass.
void keep_large_components(LabelVolume& volume, double share);

}  // namespace voxtet
