// Whether triangles intersect. First a separating plane is looked for in floating point (half_space.h); exact
// signs decide the rest (orientation.h). All triangles must have an area.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/elements/triangle_measures.h"
#include "types/surface_mesh.h"

namespace voxtet {

/// Whether triangles without common corners, as closed sets, intersect.
bool triangles_meet(const TriangleCorners& a, const TriangleCorners& b);

/// Whether triangles whose common corner comes first in both meet elsewhere.
bool triangles_meet_beyond_corner(const TriangleCorners& a, const TriangleCorners& b);

/// True if the intersection of the two triangles is more than their common corners or common edge (common
/// means: the same index). A triangle and itself, or its duplicate, intersect.
bool triangles_intersect(const std::vector<Eigen::Vector3d>& points, const Triangle& a, const Triangle& b);

}  // namespace voxtet
