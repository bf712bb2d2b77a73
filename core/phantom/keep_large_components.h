// Removes small components that sampling cuts off from a body.
#pragma once

#include <functional>

#include "types/label_volume.h"

namespace voxtet {

/// Relabels 6-connected components of labels (not of background): those smaller than a twentieth of their
/// label's largest, and all but the `most(label)` largest ones. Each gets the most frequent other label among
/// its face neighbours (of equals the lower one). Repeated until there is no such component. Linear time per
/// pass.
void keep_large_components(LabelVolume& volume, const std::function<std::size_t(Label)>& most);

}  // namespace voxtet
