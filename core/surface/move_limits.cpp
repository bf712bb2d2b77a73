#include "surface/move_limits.h"

#include <cmath>

namespace voxtet {
namespace {

constexpr double kOnEdge = 1e-3;  ///< voxels; other vertices are at least 1/6 from the middle of an edge

std::uint8_t kind_of(const Eigen::Vector3d& start, const VoxelRegions& regions) {
  std::array<int, 3> p{}, q{}, step{};
  for (std::size_t d = 0; d < 3; ++d) {
    const double twice = std::round(2 * start[static_cast<Eigen::Index>(d)]);
    if (std::abs(twice - 2 * start[static_cast<Eigen::Index>(d)]) > kOnEdge) return 0;
    p[d] = static_cast<int>(std::floor(twice / 2));
    q[d] = static_cast<int>(std::ceil(twice / 2));
    step[d] = q[d] - p[d];
  }
  const bool p_is_thin =
      regions.at(p[0] - step[0], p[1] - step[1], p[2] - step[2]) != regions.at(p[0], p[1], p[2]);
  const bool q_is_thin =
      regions.at(q[0] + step[0], q[1] + step[1], q[2] + step[2]) != regions.at(q[0], q[1], q[2]);
  unsigned kind = 0;
  for (unsigned d = 0; d < 3; ++d) {
    if (step[d] == 0) continue;
    if (p_is_thin) kind |= 1U << d;
    if (q_is_thin) kind |= 8U << d;
  }
  return static_cast<std::uint8_t>(kind);
}

}  // namespace

MoveLimits::MoveLimits(const std::vector<Eigen::Vector3d>& start, const VoxelRegions& regions, double reach) {
  for (unsigned kind = 0; kind < kKinds; ++kind)
    for (int d = 0; d < 3; ++d) {
      boxes_[kind].low[d] = (kind >> d & 1U) != 0 ? 0 : -reach;
      boxes_[kind].high[d] = (kind >> (3 + d) & 1U) != 0 ? 0 : reach;
    }
  kinds_.reserve(start.size());
  for (const Eigen::Vector3d& vertex : start) kinds_.push_back(kind_of(vertex, regions));
}

}  // namespace voxtet
