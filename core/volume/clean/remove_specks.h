// Removes small components of the labels and of background, if the user asks for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>

#include "types/label_volume.h"

namespace voxtet {

/// Sizes below which 6-connected components are removed, in voxels; 0 removes none.
struct SpeckLimits {
  std::uint32_t speck_voxels = 0;  ///< components of a label, apart from its largest
  std::uint32_t hole_voxels = 0;   ///< components of background that do not touch the volume's border
};

/// What was removed of a label; of background: the holes that were filled.
struct RemovedPieces {
  std::size_t pieces = 0, voxels = 0;
  std::size_t largest = 0;  ///< voxels of the largest of them
};

/// Each small component gets the other label with which it shares the largest face area (mm^2; of equals the
/// lower label). The smallest components come first (of equals the one whose first voxel comes first); each
/// sees the labels that the ones before it got. Linear time apart from sorting the small components.
std::map<Label, RemovedPieces> remove_specks(LabelVolume& volume, const SpeckLimits& limits);

}  // namespace voxtet
