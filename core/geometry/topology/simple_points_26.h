// A voxel's 26 neighbours, and simple points for a label that is connected through faces only while its
// complement is connected along diagonals of faces too.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/topology/simple_points.h"

namespace voxtet {

/// Neighbours x, y, z = -1, 0, 1, x fastest; the voxel itself is in the middle.
constexpr std::size_t kCube = 27, kCubeMiddle = 13;

constexpr std::array<int, 3> cube_step(std::size_t neighbour) {
  const int n = static_cast<int>(neighbour);
  return {n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
}

/// For each neighbour, the others in the cube next to it, as bits: those that differ along at most `axes`
/// axes.
constexpr NeighbourRings<kCube> cube_rings(int axes) {
  NeighbourRings<kCube> rings{};
  for (std::size_t a = 0; a < kCube; ++a)
    for (std::size_t b = 0; b < kCube; ++b) {
      int differing = 0;
      bool near = a != b && b != kCubeMiddle;
      for (std::size_t d = 0; d < 3; ++d) {
        const int step = cube_step(b)[d] - cube_step(a)[d];
        near = near && step >= -1 && step <= 1;
        differing += step != 0 ? 1 : 0;
      }
      if (near && differing <= axes) rings[a] |= 1U << b;
    }
  return rings;
}
inline constexpr NeighbourRings<kCube> kFaceRings = cube_rings(1), kEdgeRings = cube_rings(2);

/// How many connected pieces of `cube` touch the middle.
constexpr int pieces_at_middle(std::uint32_t cube, const NeighbourRings<kCube>& rings) {
  int pieces = 0;
  for (std::uint32_t touching = cube & rings[kCubeMiddle]; touching != 0; ++pieces)
    touching &= ~grow_piece(touching & -touching, cube, rings);
  return pieces;
}

/// Whether the middle can be removed from or added to a set without a change of topology. `in_set`: the
/// members of the cube that are in the set, as bits (Bertrand 1994 for the connectivities 6+ and 18).
constexpr bool is_simple_in_cube(std::uint32_t in_set) {
  constexpr std::uint32_t kAll = ((1U << kCube) - 1) & ~(1U << kCubeMiddle);
  return pieces_at_middle(in_set & kAll, kFaceRings) == 1 &&
         pieces_at_middle(kAll & ~in_set, kEdgeRings) == 1;
}

}  // namespace voxtet
