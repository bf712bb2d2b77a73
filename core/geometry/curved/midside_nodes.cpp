#include "geometry/curved/midside_nodes.h"

#include <algorithm>

#include "geometry/topology/adjacency.h"

namespace voxtet {

MidsideNodes straight_midside_nodes(const TetMesh& mesh) {
  MidsideNodes nodes;
  nodes.edges = tet_edges(mesh.tets, mesh.points.size());
  std::vector<std::uint32_t> first(mesh.points.size() + 1, 0);  // of the edges whose lesser end is this point
  for (const auto& [low, high] : nodes.edges) {
    nodes.points.emplace_back((mesh.points[low] + mesh.points[high]) / 2);
    ++first[low + 1];
  }
  for (std::size_t p = 1; p < first.size(); ++p) first[p] += first[p - 1];
  const auto edge_between = [&](std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax(a, b);
    const auto begin = nodes.edges.begin();
    const auto found = std::lower_bound(begin + first[low], begin + first[low + 1], Edge{low, high});
    return static_cast<std::uint32_t>(found - begin);
  };
  const auto edges_of = [&](const auto& corners, auto& edges) {
    for (std::size_t e = 0; e < edges.size(); ++e)
      edges[e] = edge_between(corners[kMidsidesOfTet[e].first], corners[kMidsidesOfTet[e].second]);
  };
  nodes.tets.resize(mesh.tets.size());
  nodes.faces.resize(mesh.faces.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) edges_of(mesh.tets[t], nodes.tets[t]);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) edges_of(mesh.faces[f], nodes.faces[f]);
  return nodes;
}

}  // namespace voxtet
