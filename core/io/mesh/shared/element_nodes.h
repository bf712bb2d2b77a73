// The nodes of elements in the order in which files have them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "io/mesh/shared/mesh_format.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// The points of an element, in order.
struct ElementNodes {
  std::array<std::uint32_t, 10> numbers{};
  std::size_t count = 0;
  const std::uint32_t* begin() const { return numbers.data(); }
  const std::uint32_t* end() const { return numbers.data() + count; }
};

/// Corners alone, or of second-order elements also the points on the edges in the order of kMidsidesOfTet,
/// which is that of VTK, XDMF, Abaqus and FEBio. `mesh` is as the writers see it: its points end with those
/// of `options.midside`.
ElementNodes nodes_of_tet(const TetMesh& mesh, std::size_t tet, const WriteMeshOptions& options);
/// The same in Gmsh's order, where the points on the edges 13 and 23 change places ("Gmsh Reference Manual",
/// node ordering).
ElementNodes gmsh_nodes_of_tet(const TetMesh& mesh, std::size_t tet, const WriteMeshOptions& options);
/// Of triangle `face` of the boundary faces of a mesh, or of a surface whose points end with those of
/// `options.midside`; all formats have the points of a triangle in one order.
ElementNodes nodes_of_face(const std::vector<Triangle>& faces, std::size_t face, std::size_t point_count,
                           const WriteMeshOptions& options);

/// How many nodes a tetrahedron or a triangle has: 4 and 3, or 10 and 6.
inline std::size_t nodes_per_tet(const WriteMeshOptions& options) {
  return options.midside ? 10 : 4;
}
inline std::size_t nodes_per_face(const WriteMeshOptions& options) {
  return options.midside ? 6 : 3;
}

}  // namespace voxtet
