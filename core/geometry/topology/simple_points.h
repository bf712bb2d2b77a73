// Connected pieces of a voxel's neighbours.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace voxtet {

/// For each neighbour, the others next to it, as bits.
template <std::size_t kCount>
using NeighbourRings = std::array<std::uint32_t, kCount>;

/// Everything in `within` that is connected with `piece`, a part of it.
template <std::size_t kCount>
constexpr std::uint32_t grow_piece(std::uint32_t piece, std::uint32_t within,
                                   const NeighbourRings<kCount>& rings) {
  for (std::uint32_t last = 0; piece != last;) {
    std::uint32_t fresh = piece & ~last;
    last = piece;
    for (; fresh != 0; fresh &= fresh - 1)
      piece |= rings[static_cast<std::size_t>(std::countr_zero(fresh))] & within;
  }
  return piece;
}

}  // namespace voxtet
