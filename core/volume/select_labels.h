// Selects the labels of a volume that are to be meshed, and merges those that are meshed as one region.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "types/label_volume.h"
#include "types/result.h"

namespace voxtet {

/// Labels that are to be meshed as one region.
using LabelGroup = std::vector<Label>;

/// Keeps `wanted` (empty: all) and makes everything else background; the voxels of each group of `merge`
/// carry the group's smallest label. `infos` are reduced to what is kept; it is the same volume where nothing
/// goes. Errors: kUsage for a label the volume does not hold (the message lists those it does), a group that
/// is empty or names a label that is not kept, a label named twice in the groups; kBadInput when the volume
/// holds no label at all.
Result<std::shared_ptr<const LabelVolume>> select_labels(const std::shared_ptr<const LabelVolume>& volume,
                                                         const std::vector<Label>& wanted,
                                                         const std::vector<LabelGroup>& merge);

/// Labels present (not background), ascending, each with its number of voxels.
std::vector<std::pair<Label, std::size_t>> count_labels(const LabelVolume& volume);

}  // namespace voxtet
