#include "anatomy/facet_sets.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>

#include "geometry/topology/adjacency.h"

namespace voxtet {
namespace {

/// The edges of all faces of whose surface `wanted` approves.
template <class Wanted>
std::set<Edge> edges_of(const TetMesh& mesh, const HeartSurfaces& surfaces, Wanted&& wanted) {
  std::set<Edge> edges;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (!wanted(surfaces.faces[f])) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(mesh.faces[f][i], mesh.faces[f][(i + 1) % 3]);
      edges.insert({low, high});
    }
  }
  return edges;
}

template <class Wanted>
NamedSet rim_of(const TetMesh& mesh, const HeartSurfaces& surfaces, const std::set<Edge>& of_base,
                const std::string& name, Wanted&& wanted) {
  std::set<std::uint32_t> points;
  for (const Edge& edge : edges_of(mesh, surfaces, wanted))
    if (of_base.contains(edge)) points.insert(edge.begin(), edge.end());
  return {name, {points.begin(), points.end()}};
}

}  // namespace

std::vector<NamedSet> facet_sets(const HeartSurfaces& surfaces) {
  std::vector<NamedSet> sets;
  for (const HeartSurface surface :
       {HeartSurface::kEpicardium, HeartSurface::kLvEndocardium, HeartSurface::kRvEndocardium,
        HeartSurface::kRvSeptum, HeartSurface::kBase}) {
    NamedSet set{std::string(name_of(surface)), {}};
    for (std::uint32_t f = 0; f < surfaces.faces.size(); ++f)
      if (surfaces.faces[f] == surface) set.members.push_back(f);
    if (!set.members.empty()) sets.push_back(std::move(set));
  }
  return sets;
}

std::vector<NamedSet> rim_sets(const TetMesh& mesh, const HeartSurfaces& surfaces) {
  const std::set<Edge> of_base =
      edges_of(mesh, surfaces, [](HeartSurface surface) { return surface == HeartSurface::kBase; });
  std::vector<NamedSet> sets{rim_of(mesh, surfaces, of_base, "lv_rim", [](HeartSurface surface) {
    return surface == HeartSurface::kLvEndocardium;
  })};
  if (surfaces.right)
    sets.push_back(rim_of(mesh, surfaces, of_base, "rv_rim", [](HeartSurface surface) {
      return surface == HeartSurface::kRvEndocardium || surface == HeartSurface::kRvSeptum;
    }));
  return sets;
}

}  // namespace voxtet
