// An order of work on a mesh that lets threads work at different places.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace voxtet {

struct SpreadOrder {
  std::vector<std::uint32_t> items;
  std::vector<std::size_t> ends;  ///< of groups of items, ascending; the last one is items.size()
  std::span<const std::uint32_t> group(std::size_t g) const {
    const std::size_t first = g == 0 ? 0 : ends[g - 1];
    return std::span(items).subspan(first, ends[g] - first);
  }
};

/// Items in their groups: item i is in group groups[i]. Those of a group keep their order.
SpreadOrder in_groups(std::span<const std::size_t> groups);

/// The items, by their zones' places in the span, in groups whose zones do not meet. Each one is in the first
/// group after those of all items before it whose zones meet its own; so these keep their order. Zones meet
/// where they share a cell of a lattice, and here and there by chance. The lattice is as coarse as the larger
/// zones, so that the time is linear in the number of zones.
SpreadOrder spread_order(std::span<const Eigen::AlignedBox3d> zones);

}  // namespace voxtet
