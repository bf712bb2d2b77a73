// Order along a space-filling curve: neighbours in space become neighbours in memory.
#pragma once

#include <cstddef>

#include "types/tet_mesh.h"

namespace voxtet::tetra {

/// Puts the points from `first_free` on, and all tets by their centroids, in the order of Morton's curve. The
/// points before, the faces and the order of a tet's corners stay as they are.
void order_along_curve(TetMesh& mesh, std::size_t first_free);

}  // namespace voxtet::tetra
