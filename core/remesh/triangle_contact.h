// Do triangles meet, decided exactly; and how far they are apart, in doubles.
#pragma once

#include <Eigen/Core>

#include "remesh/complex_mesh.h"

namespace voxtet::remesh {

/// Sign of the volume of the tetrahedron a, b, c, d: 1 when d sees a, b, c turn clockwise. Exact: a filter
/// in front of expansions (Shewchuk, "Adaptive precision floating-point arithmetic", 1997).
int orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                const Eigen::Vector3d& d);

/// Closed sets; exact. The triangle has an area.
bool segment_meets_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Corners& t);

/// Of triangles without common corners. Closed sets; exact.
bool triangles_meet(const Corners& a, const Corners& b);

/// Of triangles whose common corner stands first in both: do they meet elsewhere? Exact.
bool triangles_meet_beyond_corner(const Corners& a, const Corners& b);

/// Squared distance between the corners of one triangle and the other triangle, the least of the six; where
/// edges cross in front of each other the distance of the triangles may be less.
double corner_distance2(const Corners& a, const Corners& b);

/// Cosine of the angle at the edge u w between the half planes through p and q: 1 when folded, -1 when flat.
double fold_cosine(const Eigen::Vector3d& u, const Eigen::Vector3d& w, const Eigen::Vector3d& p,
                   const Eigen::Vector3d& q);

/// Cosine of the smallest angle of a triangle.
double sharpest_cosine(const Corners& t);

}  // namespace voxtet::remesh
