// An order of work on a mesh that lets threads work at different places.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>

#include "base/buckets.h"

namespace voxtet {

/// Items in their groups: item i is in group groups[i]. Those of a group keep their order.
Buckets<std::uint32_t> in_groups(std::span<const std::uint32_t> groups);

/// The items, by their zones' places in the span, in groups whose zones do not meet. Each one is in the first
/// group after those of all items before it whose zones meet its own; so these keep their order. Zones meet
/// where they share a cell of a lattice, and here and there by chance. The lattice is as coarse as the larger
/// zones, so that the time is linear in the number of zones.
Buckets<std::uint32_t> spread_order(std::span<const Eigen::AlignedBox3d> zones);

}  // namespace voxtet
