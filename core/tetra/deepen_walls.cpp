#include "tetra/deepen_walls.h"

#include <algorithm>
#include <cstdint>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "geometry/wall_mesh.h"
#include "tetra/size_guard.h"
#include "tetra/tet_complex.h"
#include "tetra/vertex_insertion.h"

namespace voxtet {
namespace {

using namespace tetra;

constexpr double kLeastAngleDeg = 25;
constexpr int kMostRounds = 50;

/// By point the fewest edges from the inner and from the outer surface of a wall.
struct Depths {
  std::vector<std::uint32_t> inner, outer;

  /// Of the shortest way along an edge.
  std::uint64_t edges_along(const Edge& edge) const {
    const auto& [a, b] = edge;
    return 1 + std::min(std::uint64_t{inner[a]} + outer[b], std::uint64_t{inner[b]} + outer[a]);
  }
};

/// The fewest of some edges that lead to each point from those at which `from` is 0.
std::vector<std::uint32_t> hops_along(const std::vector<Edge>& edges, const std::vector<std::uint32_t>& from,
                                      std::uint32_t most) {
  std::vector<std::uint32_t> hops;
  for (const std::uint32_t depth : from) hops.push_back(depth == 0 ? 0 : WallMesh::kUnreached);
  for (std::uint32_t hop = 0; hop < most; ++hop)
    for (const auto& [a, b] : edges)
      for (const auto& [p, q] : {std::pair(a, b), std::pair(b, a)})
        if (hops[p] == hop && hops[q] == WallMesh::kUnreached) hops[q] = hop + 1;
  return hops;
}

/// Puts vertices on short ways through one wall. None of the new vertices comes to lie on a short way, so
/// that all short ways there are lead along edges of short ways that there were at first.
class Deepener {
 public:
  Deepener(TetMesh mesh, const LayeredWall& wall, const SizeGuard& guard)
      : layers_(wall.layers),
        edges_(find_depths(mesh, wall)),
        complex_(std::move(mesh)),
        inserter_(complex_, guard) {}

  /// How many edges of short ways there are.
  std::size_t size() const { return edges_.size(); }

  /// Puts vertices on the longest of them, away from where it already did in this round; how many.
  std::size_t split_some() {
    std::vector<std::uint8_t> changed(complex_.point_count(), 0);
    std::stable_sort(edges_.begin(), edges_.end(),
                     [this](const Edge& x, const Edge& y) { return length2(x) > length2(y); });
    std::size_t count = 0;
    for (const Edge& edge : edges_) {
      if (changed[edge[0]] || changed[edge[1]] || !split(edge)) continue;
      ++count;
      for (const std::uint32_t t : complex_.made())
        for (const std::uint32_t v : complex_.corners(t))
          if (v < changed.size()) changed[v] = 1;
    }
    keep_short_ways();
    return count;
  }

  TetMesh release() { return std::move(complex_).release(); }

 private:
  /// Returns the edges of short ways.
  std::vector<Edge> find_depths(const TetMesh& mesh, const LayeredWall& layered) {
    const WallMesh wall(mesh, layered.field);
    least_ = {wall.from_inner(), wall.from_judged_outer()};
    std::vector<Edge> edges;
    for (const Edge& edge : wall.edges_through())
      if (least_.edges_along(edge) < layers_) edges.push_back(edge);
    return edges;
  }

  double length2(const Edge& edge) const {
    return (complex_.point(edge[0]) - complex_.point(edge[1])).squaredNorm();
  }

  /// The tets around an edge into around_; none if it is gone.
  void find_tets_around(const Edge& edge) {
    around_.clear();
    complex_.find_star(edge[0], star_);
    for (const std::uint32_t t : star_)
      if (complex_.corner_at(t, edge[1]) < 4) around_.push_back(t);
  }

  /// Whether there is a wall at an edge, whose tets are around_.
  bool is_on_wall(const Edge& edge) const {
    return std::any_of(around_.begin(), around_.end(), [&](std::uint32_t t) {
      const auto& sides = kOtherCorners[complex_.corner_at(t, edge[0])][complex_.corner_at(t, edge[1])];
      return complex_.behind(t, sides[0]) == kNone || complex_.behind(t, sides[1]) == kNone;
    });
  }

  bool split(const Edge& edge) {
    find_tets_around(edge);
    if (around_.empty() || is_on_wall(edge)) return false;
    std::uint64_t inner = WallMesh::kUnreached, outer = inner;
    const auto leaves_ways_long = [&](std::uint32_t neighbour) {
      inner = std::min<std::uint64_t>(inner, least_.inner[neighbour] + 1);
      outer = std::min<std::uint64_t>(outer, least_.outer[neighbour] + 1);
      return inner + outer >= layers_;
    };
    const Point middle = 0.5 * (complex_.point(edge[0]) + complex_.point(edge[1]));
    if (!inserter_.split(around_, middle, least_quality_, leaves_ways_long)) return false;
    least_.inner.push_back(static_cast<std::uint32_t>(inner));
    least_.outer.push_back(static_cast<std::uint32_t>(outer));
    return true;
  }

  /// Forgets the edges that are gone or no longer on a short way.
  void keep_short_ways() {
    std::erase_if(edges_, [this](const Edge& edge) {
      find_tets_around(edge);
      return around_.empty();
    });
    const Depths now{hops_along(edges_, least_.inner, layers_), hops_along(edges_, least_.outer, layers_)};
    std::erase_if(edges_, [&](const Edge& edge) { return now.edges_along(edge) >= layers_; });
  }

  const std::uint32_t layers_;
  const double least_quality_ = quality_of_angle(kLeastAngleDeg);
  Depths least_;  ///< no point has less
  std::vector<Edge> edges_;
  TetComplex complex_;
  VertexInserter inserter_;
  std::vector<std::uint32_t> star_, around_;
};

}  // namespace

Result<TetMesh> deepen_walls(TetMesh mesh, std::span<const LayeredWall> walls, const SizingField& sizing,
                             RunContext& ctx) {
  try {
    const SizeGuard guard(sizing);
    std::size_t before = 0, after = 0, count = 0;
    for (const LayeredWall& wall : walls) {
      Deepener deepener(std::move(mesh), wall, guard);
      before += deepener.size();
      for (int round = 0; round < kMostRounds; ++round) {
        if (ctx.cancelled()) return cancelled_error("optimise");
        const std::size_t split = deepener.split_some();
        if (split == 0) break;
        count += split;
      }
      after += deepener.size();
      mesh = deepener.release();
    }
    if (before > 0)
      ctx.note("optimise", "edges of ways through walls that are too short: " + std::to_string(before) +
                               ", then " + std::to_string(after) +
                               "; vertices put on them: " + std::to_string(count));
    return mesh;
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, "optimise", "memory ran out while walls were deepened", {}};
  }
}

}  // namespace voxtet
