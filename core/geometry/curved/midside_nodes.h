// Nodes in the middle of the edges of a mesh.
#pragma once

#include "types/tet_mesh.h"

namespace voxtet {

/// The second-order elements of a mesh with straight edges. `faces` must be faces of tetrahedra.
MidsideNodes straight_midside_nodes(const TetMesh& mesh);

}  // namespace voxtet
