#include "surface/smooth/move_limits.h"

#include <optional>

#include "surface/smooth/lattice_edge.h"

namespace voxtet {
namespace {

constexpr int kMostTouching = 3;

using Voxel = std::array<int, 3>;

/// A voxel of a straight wire touches the two along it; the tips of wedges and spurs, where smoothing must be
/// free, touch more than three.
bool is_slender(const Voxel& p, const VoxelRegions& regions) {
  if (regions.around(p[0], p[1], p[2]).thin_axes == 0) return false;
  const std::uint32_t own = regions.at(p[0], p[1], p[2]);
  int touching = -1;
  for (int k = p[2] - 1; k <= p[2] + 1; ++k)
    for (int j = p[1] - 1; j <= p[1] + 1; ++j)
      for (int i = p[0] - 1; i <= p[0] + 1; ++i) touching += regions.at(i, j, k) == own ? 1 : 0;
  return touching <= kMostTouching;
}

std::uint8_t kind_of(const Eigen::Vector3d& start, const VoxelRegions& regions) {
  const std::optional<LatticeEdge> edge = lattice_edge_of(start);
  if (!edge) return 0;
  const auto& [p, q] = *edge;
  const bool p_is_slender = is_slender(p, regions), q_is_slender = is_slender(q, regions);
  unsigned kind = p_is_slender || q_is_slender ? MoveLimits::kKinds : 0;
  for (unsigned d = 0; d < 3; ++d) {
    if (p[d] == q[d]) continue;
    if (p_is_slender) kind |= 1U << d;
    if (q_is_slender) kind |= 8U << d;
  }
  return static_cast<std::uint8_t>(kind);
}

}  // namespace

MoveLimits::MoveLimits(const std::vector<Eigen::Vector3d>& start, const VoxelRegions& regions,
                       const Eigen::Vector3d& reach) {
  for (unsigned kind = 0; kind < kKinds; ++kind)
    for (int d = 0; d < 3; ++d) {
      boxes_[kind].low[d] = (kind >> d & 1U) != 0 ? 0 : -reach[d];
      boxes_[kind].high[d] = (kind >> (3 + d) & 1U) != 0 ? 0 : reach[d];
    }
  kinds_.reserve(start.size());
  for (const Eigen::Vector3d& vertex : start) kinds_.push_back(kind_of(vertex, regions));
}

}  // namespace voxtet
