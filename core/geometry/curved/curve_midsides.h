// Second-order tetrahedra whose boundary follows the surface that their mesh was made from.
#pragma once

#include <cstddef>

#include "types/surface_mesh.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// From faces to the triangles of the label surface between the same two labels, mm; at seven points of each
/// face: on its edges and inside.
struct FaceDistance {
  double mean_mm = 0, max_mm = 0;
};

struct CurvedNodes {
  MidsideNodes nodes;
  std::size_t moved = 0;        ///< nodes that are off the middle of their edge
  std::size_t pulled_back = 0;  ///< nodes that went back for an element's determinant
  std::size_t held = 0;         ///< other nodes that went back, for the distance of a face
  /// The smallest over all tetrahedra of the least determinant over the greatest (determinant_bounds): 1
  /// where all are straight.
  double min_scaled_jacobian = 1;
  FaceDistance straight, curved;  ///< of faces with straight edges and as they are
};

/// The least share of the straight element's Jacobian determinant that every second-order element keeps.
inline constexpr double kLeastDeterminant = 0.2;

/// Moves the middles of boundary edges onto `surface` (label_targets.h); corners stay. Where the Jacobian
/// determinant of an element would anywhere be less than kLeastDeterminant of the straight one's, its nodes
/// go halfway back, at the fourth time all the way. So do the nodes of a face that would be farther from the
/// surface than with straight edges on average, or anywhere farther than any face with straight edges. The
/// result does not depend on `threads`.
CurvedNodes curve_midsides(const TetMesh& mesh, const SurfaceMesh& surface, int threads);

}  // namespace voxtet
