// Exact test of two triangles of a complex, cheap where they are clearly apart.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "types/surface_mesh.h"

namespace voxtet {

/// True if the intersection of the two triangles is more than their common corners or common edge (common
/// means: the same index). A triangle and itself, or its duplicate, intersect. Needs triangles with an area.
/// A separating plane is looked for in floating point first (half_space.h); exact predicates decide the rest.
bool triangles_intersect(const std::vector<Eigen::Vector3d>& points, const Triangle& a, const Triangle& b);

}  // namespace voxtet
