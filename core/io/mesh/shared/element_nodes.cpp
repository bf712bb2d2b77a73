#include "io/mesh/shared/element_nodes.h"

#include <utility>

namespace voxtet {
namespace {

template <class Corners, class Edges>
ElementNodes nodes_of(const Corners& corners, const std::vector<Edges>& edges, std::size_t element,
                      std::size_t first_midside) {
  ElementNodes nodes;
  for (const std::uint32_t corner : corners) nodes.numbers[nodes.count++] = corner;
  if (!edges.empty())
    for (const std::uint32_t edge : edges[element])
      nodes.numbers[nodes.count++] = static_cast<std::uint32_t>(first_midside + edge);
  return nodes;
}

std::size_t first_midside(std::size_t points, const WriteMeshOptions& options) {
  return options.midside ? points - options.midside->points.size() : points;
}

}  // namespace

ElementNodes nodes_of_tet(const TetMesh& mesh, std::size_t tet, const WriteMeshOptions& options) {
  static const std::vector<std::array<std::uint32_t, 6>> kNone;
  return nodes_of(mesh.tets[tet], options.midside ? options.midside->tets : kNone, tet,
                  first_midside(mesh.points.size(), options));
}

ElementNodes gmsh_nodes_of_tet(const TetMesh& mesh, std::size_t tet, const WriteMeshOptions& options) {
  ElementNodes nodes = nodes_of_tet(mesh, tet, options);
  if (options.midside) std::swap(nodes.numbers[8], nodes.numbers[9]);
  return nodes;
}

ElementNodes nodes_of_face(const std::vector<Triangle>& faces, std::size_t face, std::size_t point_count,
                           const WriteMeshOptions& options) {
  static const std::vector<std::array<std::uint32_t, 3>> kNone;
  return nodes_of(faces[face], options.midside ? options.midside->faces : kNone, face,
                  first_midside(point_count, options));
}

}  // namespace voxtet
