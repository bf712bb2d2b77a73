// Points that no element of a mesh uses.
#pragma once

#include <cstddef>

#include "types/surface_mesh.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// Leaves out points that no triangle uses; the others keep their order.
void drop_unused_points(SurfaceMesh& surface);
/// The same for tetrahedra; how many there were. The mesh's faces are emptied where points go: see
/// add_label_faces().
std::size_t drop_unused_points(TetMesh& mesh);

}  // namespace voxtet
