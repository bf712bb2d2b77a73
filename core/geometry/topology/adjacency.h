// Edges and faces of meshes, found in linear time by bucketing on the smallest corner.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "types/tet_mesh.h"

namespace voxtet {

using Edge = std::array<std::uint32_t, 2>;  ///< ascending

/// Each edge of the tetrahedra once, ascending. `point_count` bounds the corners.
std::vector<Edge> tet_edges(std::span<const Tet> tets, std::size_t point_count);

/// The result of edge_hops() for points that no edges lead to. Adding a few of them does not overflow.
inline constexpr std::uint32_t kUnreached = 0x3fffffffU;

/// For each point the number of edges on the shortest path from the points marked in `from`.
std::vector<std::uint32_t> edge_hops(std::span<const Edge> edges, const std::vector<bool>& from);

/// A face of a tetrahedral mesh and the tetrahedra on it.
struct TetFace {
  Triangle corners;               ///< ascending
  std::uint32_t first = 0;        ///< the lowest tetrahedron on it
  std::uint32_t second = kNoTet;  ///< the other one, or kNoTet
  std::uint32_t count = 0;        ///< tetrahedra on it; above 2 the mesh is broken
  static constexpr std::uint32_t kNoTet = 0xffffffffU;
};

/// Each face of the tetrahedra once, ascending by its corners.
std::vector<TetFace> tet_faces(std::span<const Tet> tets, std::size_t point_count);

/// The boundaries of all labels as TetMesh describes them, ascending by corners: the mesh's points, and the
/// faces of its tetrahedra (as `tet_faces` returns them) that lie between different labels.
SurfaceMesh label_boundary(const TetMesh& mesh, std::span<const TetFace> faces);

/// Sets `faces` and `face_sides` of a mesh that has only tetrahedra and labels, as TetMesh describes them;
/// ascending by corners.
void add_label_faces(TetMesh& mesh);

}  // namespace voxtet
