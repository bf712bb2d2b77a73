// Removes small components that sampling cuts off from a body.
#pragma once

#include "types/label_volume.h"

namespace voxtet {

/// Relabels every 6-connected component of a label (not of background) that is smaller than `share` of the
/// label's largest component: it gets the most frequent other label among its face neighbours (of equals the
/// lower one). Repeated until there is no such component. Linear time per pass.
void keep_large_components(LabelVolume& volume, double share);

}  // namespace voxtet
