// The inverse of edge removal: faces between the same two apexes are removed, and an edge joins the apexes.
// Flips 2-3, 4-4, 6-5 ...
// J. R. Shewchuk, "Two discrete optimization algorithms for the topological improvement of tetrahedral
// meshes" (2002).
#pragma once

#include <cstdint>

#include "tetra/mesh/tet_complex.h"
#include "tetra/operations/size_guard.h"

namespace voxtet::tetra {

/// Removes the side of tet t opposite to a corner, with as many neighbouring sides between the same apexes as
/// needed, if that raises the lowest quality and the new edge's size is allowed. complex.made() are then the
/// new tets.
bool remove_faces(TetComplex& complex, std::uint32_t t, std::uint32_t corner, const SizeGuard& guard);

}  // namespace voxtet::tetra
