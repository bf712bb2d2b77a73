// Small components of the labels and of background, removed on demand.
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

/// Gives each small component the other label with the largest face area to it (mm^2; the lower of equals),
/// the smallest components first (of equals the one whose first voxel comes first), each as its surroundings
/// are by then. What was removed is noted label by label: components, voxels, the largest. A label of which
/// nothing is left is warned of. Linear time apart from sorting the small components.
LabelVolume remove_specks(const LabelVolume& volume, const SpeckLimits& limits, const RunContext& ctx);

}  // namespace voxtet
