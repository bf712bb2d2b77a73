// The Jacobian determinant of second-order tetrahedra.
#pragma once

#include <Eigen/Core>
#include <array>

namespace voxtet {

/// Corners, then the nodes on the edges in the order of kMidsidesOfTet.
using Tet10Points = std::array<Eigen::Vector3d, 10>;

struct DeterminantBounds {
  double least;     ///< no value within the element is lower
  double greatest;  ///< no value within the element is higher
};

/// Bounds of det dx/d(l1, l2, l3) over a whole second-order tetrahedron; 6 V everywhere for a straight one,
/// in mm^3. The determinant is a cubic polynomial and lies between the least and the greatest of its 20
/// Bernstein coefficients, which come from those of the element's map (Johnen, Remacle, Geuzaine,
/// "Geometrical validity of curvilinear finite elements", J. Comput. Phys. 233, 2013). The element is halved
/// until the lower bound is within a hundredth of the straight element's determinant of a value that is
/// taken, at most 12 times.
DeterminantBounds determinant_bounds(const Tet10Points& nodes);

}  // namespace voxtet
