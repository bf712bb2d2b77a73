// An oracle apart from the code under test: pairs of triangles that meet elsewhere than in shared corners.
#pragma once

#include <cstddef>

#include "types/surface_mesh.h"

namespace voxtet::test {

/// Exact for the double coordinates: CGAL's box intersection for candidates, exact predicates for the
/// verdict.
std::size_t count_self_intersections(const SurfaceMesh& surface);

}  // namespace voxtet::test
