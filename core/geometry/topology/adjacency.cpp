#include "geometry/topology/adjacency.h"

#include <algorithm>
#include <utility>

#include "base/buckets.h"

namespace voxtet {
namespace {

Edge ascending(std::uint32_t a, std::uint32_t b) {
  return a < b ? Edge{a, b} : Edge{b, a};
}

Triangle ascending(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  if (a > b) std::swap(a, b);
  if (b > c) std::swap(b, c);
  if (a > b) std::swap(a, b);
  return {a, b, c};
}

template <class Visit>
void for_edges(std::span<const Tet> tets, const Visit& visit) {
  for (const Tet& t : tets)
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j)
        visit(ascending(t[static_cast<std::size_t>(i)], t[static_cast<std::size_t>(j)]));
}

template <class Visit>
void for_faces(std::span<const Tet> tets, const Visit& visit) {
  for (std::uint32_t i = 0; i < tets.size(); ++i) {
    const auto& [a, b, c, d] = tets[i];
    visit(ascending(b, c, d), i);
    visit(ascending(a, c, d), i);
    visit(ascending(a, b, d), i);
    visit(ascending(a, b, c), i);
  }
}

}  // namespace

std::vector<Edge> tet_edges(std::span<const Tet> tets, std::size_t point_count) {
  Buckets<std::uint32_t> buckets(point_count);
  for_edges(tets, [&](const Edge& e) { buckets.count(e[0]); });
  buckets.allocate();
  for_edges(tets, [&](const Edge& e) { buckets.add(e[0], e[1]); });
  std::vector<Edge> edges;
  // The low end at which each point was last met: most ends come several times, and only one is sorted.
  constexpr std::uint32_t kNever = 0xffffffffU;
  std::vector<std::uint32_t> met_at(point_count, kNever), ends;
  for (std::uint32_t low = 0; low < buckets.size(); ++low) {
    ends.clear();
    for (const std::uint32_t end : buckets.at(low))
      if (std::exchange(met_at[end], low) != low) ends.push_back(end);
    std::sort(ends.begin(), ends.end());
    for (const std::uint32_t end : ends) edges.push_back({low, end});
  }
  return edges;
}

std::vector<std::uint32_t> edge_hops(std::span<const Edge> edges, const std::vector<bool>& from) {
  std::vector<std::uint32_t> hops;
  for (const bool starts : from) hops.push_back(starts ? 0 : kUnreached);
  bool changed = true;
  for (std::uint32_t hop = 0; changed; ++hop) {
    changed = false;
    for (const auto& [a, b] : edges)
      for (const auto& [p, q] : {std::pair(a, b), std::pair(b, a)})
        if (hops[p] == hop && hops[q] == kUnreached) hops[q] = hop + 1, changed = true;
  }
  return hops;
}

std::vector<TetFace> tet_faces(std::span<const Tet> tets, std::size_t point_count) {
  struct Entry {
    std::uint32_t middle, high, tet;
  };
  Buckets<Entry> buckets(point_count);
  for_faces(tets, [&](const Triangle& f, std::uint32_t) { buckets.count(f[0]); });
  buckets.allocate();
  for_faces(tets, [&](const Triangle& f, std::uint32_t tet) { buckets.add(f[0], {f[1], f[2], tet}); });
  std::vector<TetFace> faces;
  for (std::uint32_t low = 0; low < buckets.size(); ++low) {
    const std::span<Entry> entries = buckets.at(low);
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
      return a.middle != b.middle ? a.middle < b.middle : a.high != b.high ? a.high < b.high : a.tet < b.tet;
    });
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const Entry& e = entries[i];
      if (i > 0 && e.middle == entries[i - 1].middle && e.high == entries[i - 1].high) {
        if (++faces.back().count == 2) faces.back().second = e.tet;
      } else {
        faces.push_back({{low, e.middle, e.high}, e.tet, TetFace::kNoTet, 1});
      }
    }
  }
  return faces;
}

SurfaceMesh label_boundary(const TetMesh& mesh, std::span<const TetFace> faces) {
  SurfaceMesh boundary{mesh.points, {}, {}};
  for (const TetFace& face : faces) {
    const Label first = mesh.labels[face.first];
    const Label second = face.count > 1 ? mesh.labels[face.second] : kBackground;
    if (first == second) continue;
    // Outward from the tetrahedron whose label is greater.
    const auto& [a, b, c, d] = mesh.tets[first > second ? face.first : face.second];
    for (const Triangle& outward :
         {Triangle{b, c, d}, Triangle{a, d, c}, Triangle{a, b, d}, Triangle{a, c, b}}) {
      if (ascending(outward[0], outward[1], outward[2]) != face.corners) continue;
      boundary.triangles.push_back(outward);
      boundary.sides.push_back({std::max(first, second), std::min(first, second)});
    }
  }
  return boundary;
}

void add_label_faces(TetMesh& mesh) {
  SurfaceMesh boundary = label_boundary(mesh, tet_faces(mesh.tets, mesh.points.size()));
  mesh.faces = std::move(boundary.triangles);
  mesh.face_sides = std::move(boundary.sides);
}

}  // namespace voxtet
