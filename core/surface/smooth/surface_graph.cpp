#include "surface/smooth/surface_graph.h"

#include <algorithm>
#include <array>

namespace voxtet {
namespace {

/// Number of different labels at each vertex, counted up to four.
std::vector<std::uint8_t> count_vertex_labels(const SurfaceMesh& surface) {
  std::vector<std::array<Label, 3>> seen(surface.points.size());
  std::vector<std::uint8_t> count(surface.points.size(), 0);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (const std::uint32_t v : surface.triangles[t])
      for (const Label label : surface.sides[t]) {
        const auto end = seen[v].begin() + std::min<int>(count[v], 3);
        if (count[v] == 4 || std::find(seen[v].begin(), end, label) != end) continue;
        if (count[v] < 3) seen[v][count[v]] = label;
        ++count[v];
      }
  return count;
}

/// Rows of all mesh neighbours, each as often as the edge has triangles.
void fill_neighbours(const SurfaceMesh& surface, SurfaceGraph& graph) {
  const std::size_t n = surface.points.size();
  graph.first.assign(n + 1, 0);
  for (const Triangle& t : surface.triangles)
    for (const std::uint32_t v : t) graph.first[v + 1] += 2;
  for (std::size_t v = 0; v < n; ++v) graph.first[v + 1] += graph.first[v];
  graph.neighbours.resize(6 * surface.triangles.size());
  std::vector<std::uint32_t> next(graph.first.begin(), graph.first.end() - 1);
  for (const Triangle& t : surface.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      graph.neighbours[next[t[i]]++] = t[(i + 1) % 3];
      graph.neighbours[next[t[i]]++] = t[(i + 2) % 3];
    }
}

/// Reduces each row to what smoothing uses, in place, and classifies its vertex. An edge lies on a junction
/// when it has other than two triangles.
void classify(const std::vector<std::uint8_t>& label_counts, SurfaceGraph& graph) {
  std::vector<std::uint32_t> all, junction;
  std::uint32_t begin = 0, write = 0;
  for (std::size_t v = 0; v < graph.kinds.size(); ++v) {
    const std::uint32_t end = graph.first[v + 1];
    std::sort(graph.neighbours.begin() + begin, graph.neighbours.begin() + end);
    all.clear();
    junction.clear();
    for (std::uint32_t i = begin; i < end;) {
      std::uint32_t stop = i;
      while (stop < end && graph.neighbours[stop] == graph.neighbours[i]) ++stop;
      all.push_back(graph.neighbours[i]);
      if (stop - i != 2) junction.push_back(graph.neighbours[i]);
      i = stop;
    }
    if (junction.empty() && label_counts[v] == 2)
      graph.kinds[v] = VertexKind::kSurface;
    else if (junction.size() == 2 && label_counts[v] <= 3)
      graph.kinds[v] = VertexKind::kJunction;
    else
      graph.kinds[v] = VertexKind::kFixed;
    const bool surface = graph.kinds[v] == VertexKind::kSurface;
    graph.first[v] = write;
    if (graph.kinds[v] != VertexKind::kFixed)
      for (const std::uint32_t other : surface ? all : junction) graph.neighbours[write++] = other;
    begin = end;
  }
  graph.first.back() = write;
  graph.neighbours.resize(write);
}

void fix_short_loops(SurfaceGraph& graph) {
  std::vector<bool> done(graph.kinds.size(), false);
  std::vector<std::uint32_t> chain;
  for (std::size_t start = 0; start < graph.kinds.size(); ++start) {
    if (graph.kinds[start] != VertexKind::kJunction || done[start]) continue;
    chain.assign(1, static_cast<std::uint32_t>(start));
    done[start] = true;
    bool has_end = false;
    for (std::size_t i = 0; i < chain.size(); ++i)
      for (const std::uint32_t other : graph.of(chain[i])) {
        if (graph.kinds[other] != VertexKind::kJunction) {
          has_end = true;
        } else if (!done[other]) {
          done[other] = true;
          chain.push_back(other);
        }
      }
    if (has_end || chain.size() > kLongestFixedLoop) continue;
    for (const std::uint32_t v : chain) graph.kinds[v] = VertexKind::kFixed;
  }
}

}  // namespace

SurfaceGraph build_surface_graph(const SurfaceMesh& surface) {
  SurfaceGraph graph;
  graph.kinds.assign(surface.points.size(), VertexKind::kFixed);
  fill_neighbours(surface, graph);
  classify(count_vertex_labels(surface), graph);
  fix_short_loops(graph);
  return graph;
}

}  // namespace voxtet
