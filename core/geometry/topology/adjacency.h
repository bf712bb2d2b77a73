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

/// What edge_hops() gives points that no edges lead to. Two of them and a few more add up without overflow.
inline constexpr std::uint32_t kUnreached = 0x3fffffffU;

/// By point the fewest of the edges that lead to it from the points marked in `from`.
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

/// The boundaries of all labels: the mesh's points and those of its tetrahedra's faces (as `tet_faces` gives
/// them) that lie between different labels, as TetMesh describes them; ascending by corners.
SurfaceMesh label_boundary(const TetMesh& mesh, std::span<const TetFace> faces);

/// Sets `faces` and `face_sides` of a mesh that has only tetrahedra and labels, as TetMesh describes them;
/// ascending by corners.
void add_label_faces(TetMesh& mesh);

}  // namespace voxtet
