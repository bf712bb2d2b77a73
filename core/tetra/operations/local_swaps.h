// Swaps at single tets: removal of edges and of faces.
#pragma once

#include <cstdint>

#include "tetra/operations/edge_removal.h"
#include "tetra/operations/face_removal.h"

namespace voxtet::tetra {

enum class Swap { kNone, kEdge, kFaces };

/// Removes the first of a tet's edges, or else of its sides, whose removal raises the lowest quality there.
/// complex.made() are then the new tets.
inline Swap swap_at(TetComplex& complex, std::uint32_t t, const SizeGuard& guard) {
  for (std::uint32_t i = 0; i < 4; ++i)
    for (std::uint32_t j = 0; j < i; ++j)
      if (remove_edge(complex, t, i, j, guard)) return Swap::kEdge;
  for (std::uint32_t c = 0; c < 4; ++c)
    if (remove_faces(complex, t, c, guard)) return Swap::kFaces;
  return Swap::kNone;
}

}  // namespace voxtet::tetra
