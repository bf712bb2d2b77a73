// In which order and direction the voxels of a volume are meshed.
#pragma once

#include <array>

#include "types/label_volume.h"

namespace voxtet {

/// New axis d of a volume is its old axis `axis[d]`, in reverse direction where `reversed[d]`.
struct AxisOrder {
  std::array<int, 3> axis{0, 1, 2};
  std::array<bool, 3> reversed{false, false, false};

  bool is_identity() const { return *this == AxisOrder{}; }
  bool operator==(const AxisOrder&) const = default;
};

/// The order in which a volume is meshed, so that the mesh does not depend on how a file stores its voxels:
/// the axes nearest to right, anterior, superior, with one of them reversed where that suits the labels
/// better. The Kuhn subdivision joins voxels that touch only across an edge along one of a cell's four
/// diagonals, that from its first to its last corner. The best choice of this diagonal joins most voxels of
/// labels and fewest of background: then walls one or two voxels thick have no holes.
AxisOrder mesh_order(const LabelVolume& labels);

/// The same voxels at the same places, stored in another order.
LabelVolume reordered(const LabelVolume& volume, const AxisOrder& order);

}  // namespace voxtet
