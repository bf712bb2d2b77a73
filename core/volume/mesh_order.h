// In which order and direction the voxels of a volume are meshed.
#pragma once

#include <array>

#include "types/label_volume.h"

namespace voxtet {

/// New axis d of a volume is its axis `axis[d]`, run through backwards where `reversed[d]`.
struct AxisOrder {
  std::array<int, 3> axis{0, 1, 2};
  std::array<bool, 3> reversed{false, false, false};

  bool is_identity() const { return *this == AxisOrder{}; }
  bool operator==(const AxisOrder&) const = default;
};

/// The order in which a volume is meshed, so that the mesh does not depend on how a file stores its voxels:
/// the axes nearest to right, anterior, superior, and one of them backwards where that suits the labels
/// better. What touches across edges of voxels alone is joined along one of a cell's four diagonals, that
/// from its first to its last corner (the Kuhn subdivision); suited best are the labels by the diagonal that
/// joins most of them and least background, for walls of a voxel or two then have no holes.
AxisOrder mesh_order(const LabelVolume& labels);

/// The same voxels at the same places, stored in another order.
LabelVolume reordered(const LabelVolume& volume, const AxisOrder& order);

}  // namespace voxtet
