// Removes an edge: the tets around it are replaced by two for each triangle of a triangulation of their ring.
// Flips 3-2, 4-4, 5-6, 6-8, 7-10.
// G. T. Klincsek, "Minimal triangulations of polygonal domains", Ann. Discrete Math. 9 (1980);
// J. R. Shewchuk, "Two discrete optimization algorithms for the topological improvement of tetrahedral
// meshes" (2002).
#pragma once

#include <array>
#include <cstdint>

#include "tetra/mesh/tet_complex.h"
#include "tetra/operations/size_guard.h"

namespace voxtet::tetra {

/// The best triangulation of a ring: `triangles` of indices into it, size - 2 of them, and the lowest quality
/// of the tets it gives.
struct RingFilling {
  double quality = 0;
  std::array<std::array<std::uint32_t, 3>, EdgeRing::kMost - 2> triangles;
};

/// The filling whose lowest quality is best. If none is better than `least`, its quality is 0 and its
/// triangles are undefined.
RingFilling fill_ring(const TetComplex& complex, const EdgeRing& ring, double least);

/// Removes the edge between two corners of tet t when that raises the lowest quality around it and the sizes
/// of the new edges are allowed. complex.made() are then the new tets.
bool remove_edge(TetComplex& complex, std::uint32_t t, std::uint32_t i, std::uint32_t j,
                 const SizeGuard& guard);

}  // namespace voxtet::tetra
