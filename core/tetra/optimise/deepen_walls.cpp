#include "tetra/optimise/deepen_walls.h"

#include <algorithm>
#include <cstdint>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "geometry/topology/adjacency.h"
#include "tetra/mesh/tet_complex.h"
#include "tetra/operations/size_guard.h"
#include "tetra/operations/vertex_insertion.h"
#include "types/stage_names.h"
#include "walls/wall_mesh.h"

namespace voxtet {
namespace {

using namespace tetra;

constexpr double kLeastAngleDeg = 25;
constexpr int kDeepeningRounds = 50;

/// By point the fewest edges from the inner and from the outer surface of a wall.
struct Depths {
  std::vector<std::uint32_t> inner, outer;

  /// Of the shortest path along an edge.
  std::uint32_t edges_along(const Edge& edge) const {
    const auto& [a, b] = edge;
    return 1 + std::min(inner[a] + outer[b], inner[b] + outer[a]);
  }
};

/// The edges of paths that are too short, and how deep all points are.
struct ShortPaths {
  std::vector<Edge> edges;
  Depths depths;
};

ShortPaths find_short_paths(const TetMesh& mesh, const LayeredWall& layered) {
  const WallMesh wall(mesh, layered.field);
  ShortPaths paths{{}, {wall.from_inner(), wall.from_judged_outer()}};
  for (const Edge& edge : wall.edges_through())
    if (paths.depths.edges_along(edge) < layered.layers) paths.edges.push_back(edge);
  return paths;
}

std::vector<bool> points_at_0(const std::vector<std::uint32_t>& depths) {
  std::vector<bool> points;
  for (const std::uint32_t depth : depths) points.push_back(depth == 0);
  return points;
}

/// Puts vertices on short paths through one wall. None of the new vertices comes to lie on a short path, so
/// that all short paths there are lead along edges of short paths that there were at first.
class Deepener {
 public:
  Deepener(TetMesh mesh, ShortPaths paths, std::uint32_t layers, const SizeGuard& guard)
      : complex_(std::move(mesh)),
        inserter_(complex_, guard),
        edges_(std::move(paths.edges)),
        least_(std::move(paths.depths)),
        layers_(layers) {}

  /// How many edges of short paths there are.
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
  double length2(const Edge& edge) const {
    return (complex_.point(edge[0]) - complex_.point(edge[1])).squaredNorm();
  }

  /// The tets around an edge into around_; none if it is gone.
  void find_tets_around(const Edge& edge) {
    around_.clear();
    complex_.find_star(edge[0], seen_, star_);
    for (const std::uint32_t t : star_)
      if (complex_.corner_at(t, edge[1]) < 4) around_.push_back(t);
  }

  /// Whether there is an interface at an edge, whose tets are around_.
  bool is_on_interface(const Edge& edge) const {
    return std::any_of(around_.begin(), around_.end(), [&](std::uint32_t t) {
      const auto& sides = kOtherCorners[complex_.corner_at(t, edge[0])][complex_.corner_at(t, edge[1])];
      return complex_.behind(t, sides[0]) == kNone || complex_.behind(t, sides[1]) == kNone;
    });
  }

  bool split(const Edge& edge) {
    find_tets_around(edge);
    if (around_.empty() || is_on_interface(edge)) return false;
    std::uint32_t inner = kUnreached, outer = kUnreached;
    const auto leaves_ways_long = [&](std::uint32_t neighbour) {
      inner = std::min(inner, least_.inner[neighbour] + 1);
      outer = std::min(outer, least_.outer[neighbour] + 1);
      return inner + outer >= layers_;
    };
    const Point middle = 0.5 * (complex_.point(edge[0]) + complex_.point(edge[1]));
    if (!inserter_.split(around_, middle, least_quality_, leaves_ways_long)) return false;
    least_.inner.push_back(inner);
    least_.outer.push_back(outer);
    return true;
  }

  /// Forgets the edges that are gone or no longer on a short path.
  void keep_short_ways() {
    std::erase_if(edges_, [this](const Edge& edge) {
      find_tets_around(edge);
      return around_.empty();
    });
    const Depths now{edge_hops(edges_, points_at_0(least_.inner)),
                     edge_hops(edges_, points_at_0(least_.outer))};
    std::erase_if(edges_, [&](const Edge& edge) { return now.edges_along(edge) >= layers_; });
  }

  TetComplex complex_;
  VertexInserter inserter_;
  std::vector<Edge> edges_;
  Depths least_;  ///< no point has less
  const std::uint32_t layers_;
  const double least_quality_ = quality_of_angle(kLeastAngleDeg);
  IdSet seen_;
  std::vector<std::uint32_t> star_, around_;
};

}  // namespace

Result<TetMesh> deepen_walls(TetMesh mesh, std::span<const LayeredWall> walls, const SizingField& sizing,
                             RunContext& ctx) {
  try {
    const SizeGuard guard(sizing);
    std::size_t before = 0, after = 0, count = 0;
    for (const LayeredWall& wall : walls) {
      ShortPaths paths = find_short_paths(mesh, wall);
      if (paths.edges.empty()) continue;
      before += paths.edges.size();
      Deepener deepener(std::move(mesh), std::move(paths), wall.layers, guard);
      for (int round = 0; round < kDeepeningRounds; ++round) {
        if (ctx.cancelled()) return cancelled_error(kOptimiseStage);
        const std::size_t split = deepener.split_some();
        if (split == 0) break;
        count += split;
      }
      after += deepener.size();
      mesh = deepener.release();
    }
    if (before > 0)
      ctx.note(kOptimiseStage, "edges of paths through walls that are too short: " + std::to_string(before) +
                                   ", then " + std::to_string(after) +
                                   "; vertices put on them: " + std::to_string(count));
    return mesh;
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, kOptimiseStage, "memory ran out while walls were deepened", {}};
  }
}

}  // namespace voxtet
