// The part of a volume that is to be meshed.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "types/label_volume.h"
#include "types/result.h"

namespace voxtet {

/// Keeps `wanted` (empty: all) and makes everything else background; with `merge` all kept voxels carry the
/// smallest kept label. `infos` are reduced to what is kept.
/// Errors: kUsage for a label the volume does not hold (the message lists those it does); kBadInput when the
/// volume holds no label at all.
Result<LabelVolume> select_labels(const LabelVolume& volume, const std::vector<Label>& wanted, bool merge);

/// Labels present (not background), ascending, each with its number of voxels.
std::vector<std::pair<Label, std::size_t>> count_labels(const LabelVolume& volume);

}  // namespace voxtet
