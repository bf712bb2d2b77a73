// On which side of a plane or a line a point lies, decided exactly.
#pragma once

#include <Eigen/Core>

namespace voxtet {

/// Sign of the volume of the tetrahedron a, b, c, d (tet_measures.h): 1, 0 or -1. A floating-point filter in
/// front of exact expansions (Shewchuk, "Adaptive precision floating-point arithmetic and fast robust
/// geometric predicates", 1997); the same on every platform. Exact for coordinates that are 0 or between
/// 1e-75 and 1e100 in size, where nothing underflows or overflows.
int orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                const Eigen::Vector3d& d);

/// Sign of the area of the triangle a, b, c as seen along an axis (0, 1 or 2, from its positive end), in the
/// two other coordinates: 1 when counterclockwise. Exact as above.
int orientation_along(int axis, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

}  // namespace voxtet
