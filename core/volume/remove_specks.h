// Removes small components of the labels and of background, if the user asks for it.
#pragma once

#include <cstdint>

#include "types/label_volume.h"
#include "types/run_context.h"

namespace voxtet {

/// Sizes below which 6-connected components are removed, in voxels; 0 removes none.
struct SpeckLimits {
  std::uint32_t speck_voxels = 0;  ///< components of a label
  std::uint32_t hole_voxels = 0;   ///< components of background that do not touch the volume's border
};

/// Each small component gets the other label with which it shares the largest face area (mm^2; of equals the
/// lower label). The smallest components come first (of equals the one whose first voxel comes first); each
/// sees the labels that the ones before it got. Notes for each label what was removed: components, voxels,
/// the largest. Warns of a label of which nothing is left. Linear time apart from sorting the small
/// components.
LabelVolume remove_specks(const LabelVolume& volume, const SpeckLimits& limits, const RunContext& ctx);

}  // namespace voxtet
