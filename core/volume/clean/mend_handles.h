// Opens handles, closes tunnels and fills pits that are one voxel wide, if the user asks for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>

#include "geometry/topology/label_components.h"
#include "types/label_volume.h"

namespace voxtet {

/// What was done to a label, and by how many voxels.
struct MendedLabel {
  std::size_t opened = 0, opened_voxels = 0;  ///< handles, from which voxels were taken
  std::size_t closed = 0, closed_voxels = 0;  ///< tunnels through the label, into which voxels were put
  std::size_t pits = 0, pit_voxels = 0;       ///< pits of background that were filled
};

/// A handle or tunnel is mended by giving fewer than `limit_voxels` voxels of one label, or of background,
/// the label with which they share the largest face area: first all of a thin part (voxels in no block of 2 x
/// 2 x 2 of their label), the smallest parts first; then single voxels that are left. Only what takes handles
/// from labels is done, and nothing that makes or ends a handle, piece or cavity of another one. Then pits of
/// background are filled that are one voxel wide and two or more deep, with fewer than `limit_voxels`. The
/// order is that of the grid. Time is linear but for what is searched around each handle.
std::map<Label, MendedLabel> mend_handles(LabelVolume& volume, std::uint32_t limit_voxels,
                                          Connectivity connectivity);

}  // namespace voxtet
