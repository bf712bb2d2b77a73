// A voxel's neighbours along the edges of the Kuhn tetrahedra, and simple points for this connectivity.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/topology/simple_points.h"

namespace voxtet {

/// Seven upward steps, whose axes are the bits of their number plus one, then the seven opposite ones.
constexpr std::size_t kUp = 7, kNeighbours = 14;

constexpr std::array<int, 3> step_to(std::size_t neighbour) {
  const int sign = neighbour < kUp ? 1 : -1, bits = static_cast<int>(neighbour % kUp) + 1;
  return {sign * (bits & 1), sign * (bits >> 1 & 1), sign * (bits >> 2)};
}

/// For each neighbour, the others that are neighbours of it, as bits: a ring around the edge to it.
inline constexpr NeighbourRings<kNeighbours> kRings = [] {
  NeighbourRings<kNeighbours> rings{};
  for (std::size_t a = 0; a < kNeighbours; ++a)
    for (std::size_t b = 0; b < kNeighbours; ++b) {
      bool up = a != b, down = a != b;
      for (std::size_t d = 0; d < 3; ++d) {
        const int step = step_to(b)[d] - step_to(a)[d];
        up = up && (step == 0 || step == 1);
        down = down && (step == 0 || step == -1);
      }
      if (up || down) rings[a] |= 1U << b;
    }
  return rings;
}();

/// Whether these neighbours (bits) are connected with each other; true for none.
constexpr bool are_joined(std::uint32_t neighbours) {
  return grow_piece(neighbours & -neighbours, neighbours, kRings) == neighbours;
}

/// Whether a voxel can be removed from or added to a set without a change of topology. `in_set`: its
/// neighbours in the set (Bertrand 1994). True if these and the other neighbours form one piece each.
constexpr bool is_simple(std::uint32_t in_set) {
  constexpr std::uint32_t kAll = (1U << kNeighbours) - 1;
  return in_set != 0 && in_set != kAll && are_joined(in_set) && are_joined(kAll & ~in_set);
}

}  // namespace voxtet
