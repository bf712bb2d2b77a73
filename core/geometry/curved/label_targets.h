// Where the middles of a mesh's boundary edges belong on the surface that the mesh was made from.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "types/surface_mesh.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// For each of `nodes.edges` the point of `surface` that is closest to its middle, among triangles between
/// the same two labels; for edges where more than two faces, or others, meet, and for rims (where two faces
/// turn by more than 60 degrees), among the edges of `surface` at which the same labels meet in the same way.
/// An edge's own middle where it is inside of a label, where the surface has nothing alike, where the closest
/// triangle faces the other way (the far side of a thin wall), or is farther than a quarter of the edge.
std::vector<Eigen::Vector3d> label_targets(const TetMesh& mesh, const MidsideNodes& nodes,
                                           const SurfaceMesh& surface, int threads);

}  // namespace voxtet
