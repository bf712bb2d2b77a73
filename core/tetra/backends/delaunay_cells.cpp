#include "tetra/backends/delaunay_cells.h"

#include <algorithm>

#include "tetra/mesh/triangle_index.h"

namespace voxtet::tetra {

DelaunayCells::DelaunayCells(std::span<const Eigen::Vector3d> points) {
  for (const Eigen::Vector3d& p : points) triangulation_.add_point(p);
}

bool DelaunayCells::add(std::uint32_t vertex) {
  if (triangulation_.in_use(vertex)) return true;
  const Eigen::Vector3d p = triangulation_.point(vertex);
  const std::uint32_t first = triangulation_.locate(p, last_made_);
  if (triangulation_.has_corner_at(first, p)) return false;
  insert(vertex, first);
  return true;
}

bool DelaunayCells::add(const Eigen::Vector3d& point) {
  const std::uint32_t first = triangulation_.locate(point, last_made_);
  if (triangulation_.has_corner_at(first, point)) return false;
  insert(triangulation_.add_point(point), first);
  return true;
}

void DelaunayCells::insert(std::uint32_t vertex, std::uint32_t first) {
  triangulation_.find_cavity(triangulation_.point(vertex), first, cavity_);
  triangulation_.stock_up(stock_, cavity_.rim.size());
  triangulation_.insert(vertex, cavity_, stock_);
  last_made_ = stock_.made.front();
}

bool DelaunayCells::has_edge(std::uint32_t a, std::uint32_t b) {
  triangulation_.find_star(a, cavity_);
  return std::any_of(cavity_.cells.begin(), cavity_.cells.end(),
                     [&](std::uint32_t cell) { return triangulation_.corner_at(cell, b) < 4; });
}

/// Calls visit(facet, triangle, behind) for every triangle of the surface that is a facet, as seen from one
/// of its cells; behind: the cell lies where sides[0] stands.
template <class Visit>
void DelaunayCells::for_each_facet(const SurfaceMesh& surface, const Visit& visit) const {
  const TriangleIndex index(surface);
  for (std::uint32_t cell = 0; cell < triangulation_.slots(); ++cell) {
    if (!triangulation_.is_finite(cell)) continue;
    const auto& c = triangulation_.corners(cell);
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t other = triangulation_.neighbour(cell, i);
      if (other < cell && triangulation_.is_finite(other)) continue;
      const auto& [j, k, l] = kFacetCorners[i];
      const auto [triangle, same] = index.find({c[j], c[k], c[l]});
      if (triangle != TriangleIndex::kNone) visit(4 * cell + i, triangle, same);
    }
  }
}

std::vector<bool> DelaunayCells::find_facets(const SurfaceMesh& surface) const {
  std::vector<bool> found(surface.triangles.size(), false);
  for_each_facet(surface, [&](std::uint32_t, std::uint32_t triangle, bool) { found[triangle] = true; });
  return found;
}

bool DelaunayCells::label(const SurfaceMesh& surface) {
  DelaunayTriangulation& t = triangulation_;
  std::vector<bool> on_surface(4 * static_cast<std::size_t>(t.slots()), false), known(t.slots(), false);
  std::vector<std::uint32_t> reached;
  bool sound = true;
  const auto give = [&](std::uint32_t cell, Label label) {
    if (!known[cell]) reached.push_back(cell);
    sound = sound && (!known[cell] || t.label(cell) == label);
    known[cell] = true;
    t.set_label(cell, label);
  };
  for_each_facet(surface, [&](DelaunayTriangulation::Facet facet, std::uint32_t triangle, bool behind) {
    const Sides& sides = surface.sides[triangle];
    const DelaunayTriangulation::Facet other = t.across(facet);
    on_surface[facet] = on_surface[other] = true;
    give(DelaunayTriangulation::cell_of(facet), sides[behind ? 0 : 1]);
    give(DelaunayTriangulation::cell_of(other), sides[behind ? 1 : 0]);
  });
  while (sound && !reached.empty()) {
    const std::uint32_t cell = reached.back();
    reached.pop_back();
    for (std::uint32_t i = 0; i < 4; ++i)
      if (!on_surface[4 * static_cast<std::size_t>(cell) + i]) give(t.neighbour(cell, i), t.label(cell));
  }
  return sound;
}

FilledParts DelaunayCells::take() const {
  FilledParts parts;
  std::vector<std::uint32_t> numbers(triangulation_.point_count());
  for (std::uint32_t v = 0; v < numbers.size(); ++v) {
    numbers[v] = static_cast<std::uint32_t>(parts.points.size());
    if (triangulation_.in_use(v)) parts.points.push_back(triangulation_.point(v));
  }
  for (std::uint32_t cell = 0; cell < triangulation_.slots(); ++cell) {
    if (!triangulation_.is_finite(cell) || triangulation_.label(cell) == kBackground) continue;
    const auto& [a, b, c, d] = triangulation_.corners(cell);
    parts.tets.push_back({numbers[a], numbers[b], numbers[c], numbers[d]});
    parts.regions.push_back(triangulation_.label(cell));
  }
  return parts;
}

}  // namespace voxtet::tetra
