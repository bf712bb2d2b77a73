// Shape measures of a tetrahedron. Formulas as in Shewchuk, "What is a good linear element?" (2002), and
// Liu and Joe, "Relationship between tetrahedron shape measures" (1994).
#pragma once

#include <Eigen/Core>
#include <array>
#include <utility>

namespace voxtet {

/// The corners of a tetrahedron.
using TetCorners = std::array<Eigen::Vector3d, 4>;

/// Edges of a tetrahedron as pairs of corners; edge e is opposite to edge 5 - e.
inline constexpr std::array<std::pair<int, int>, 6> kEdgesOfTet{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// Signed volume: positive when corner 3 sees 0, 1, 2 counterclockwise from inside,
/// (p1-p0).((p2-p0)x(p3-p0))/6.
double tet_volume_mm3(const TetCorners& p);

/// Of its six edges.
double mean_edge_mm(const TetCorners& p);

/// All reported measures of one tetrahedron. Ratios are 1 for the regular one and tend to 0 (aspect:
/// infinity) for a degenerate one. Inverted tetrahedra have ratios 0, and dihedral angles as if they were not
/// inverted.
struct TetShape {
  double volume_mm3 = 0;                 ///< signed
  std::array<double, 6> edge_mm{};       ///< in the order of kEdgesOfTet
  std::array<double, 6> dihedral_deg{};  ///< at the edges, in the order of kEdgesOfTet; regular: 70.529
  double radius_ratio = 0;               ///< 3 r / R, inradius over circumradius
  double mean_ratio = 0;                 ///< 12 (3 V)^(2/3) / sum of squared edges
  double aspect_ratio = 0;               ///< longest edge / (2 sqrt(6) r)
};

TetShape measure_tet(const TetCorners& p);

}  // namespace voxtet
