// Fewer vertices for a smoothed surface of several labels: those from diagonals of the lattice are joined to
// others.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "types/label_volume.h"
#include "types/run_context.h"
#include "types/surface_mesh.h"

namespace voxtet {

/// What is left: triangles with new numbers of their corners, and the old numbers of vertices and triangles.
struct JoinedSurface {
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> vertex_of, triangle_of;
};

/// Marching tetrahedra put a vertex on each edge of the Kuhn tetrahedra that a label's boundary crosses;
/// three in four of these edges are diagonals of the lattice. Once the surface is smooth, most of these
/// vertices say nothing that their neighbours do not. Joins them to neighbours on edges between voxels that
/// share a face, as marching cubes would have alone, and so leaves a third of the triangles, or half where
/// much is thin. Vertices that are left do not move.
///
/// Topology stays: an edge is collapsed only inside one interface and under the link condition (Dey et al.,
/// "Topology preserving edge contraction", 1999). A joined vertex is not far from the planes of the triangles
/// that replace its own. No triangle turns over or passes a voxel's centre, as it is or at its start.
/// Vertices beside thin structures (voxels outside of every block of 2 x 2 x 2 of their label) stay, as do
/// those of junctions.
///
/// `start` and `points`: in index space, before and after smoothing. `surface` is one of marching tetrahedra,
/// for its triangles. Linear time. None when cancelled.
std::optional<JoinedSurface> join_diagonals(const LabelVolume& volume, const SurfaceMesh& surface,
                                            const std::vector<Eigen::Vector3d>& start,
                                            const std::vector<Eigen::Vector3d>& points,
                                            const RunContext& ctx);

}  // namespace voxtet
