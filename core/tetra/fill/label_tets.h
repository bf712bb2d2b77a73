// From regions to labels, and the proof that the tetrahedra fill the surface exactly.
#pragma once

#include "tetra/backends/filled_parts.h"
#include "types/result.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// Gives each region the label on its side of the surface's triangles, and checks the whole: the surface's
/// points come first and unmoved, every point is used, every tet is positive, every triangle is a face of
/// exactly one tet on each side that has a label, no region touches two labels (a leak), and each label's
/// volume equals that enclosed by its boundary to 1e-9 relative. kMeshing with the place otherwise.
Result<TetMesh> label_tets(const SurfaceMesh& surface, FilledParts filled);

}  // namespace voxtet
