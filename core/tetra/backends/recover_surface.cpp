#include "tetra/backends/recover_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geometry/elements/surface_measures.h"
#include "tetra/mesh/edge_groups.h"
#include "tetra/mesh/meshing_error.h"
#include "types/stage_names.h"

namespace voxtet::tetra {
namespace {

using Eigen::Vector3d;

/// Between the diagonals of two triangles, as a part of the edge to be flipped.
constexpr double kFlatSine = 0.1;
constexpr int kMostRounds = 12;
/// Points of the surface for every one added, at least.
constexpr std::size_t kPointsForOne = 5;
/// As many may be added to the smallest surface.
constexpr std::size_t kAlwaysAllowed = 100;

/// One look at all edges: each triangle is changed at most once.
class Round {
 public:
  Round(SurfaceMesh& surface, DelaunayCells& cells, Recovery& done)
      : surface_(surface), cells_(cells), done_(done), edges_(surface), changed_(surface.triangles.size()) {}

  /// False where everything was there.
  bool run() {
    const std::vector<bool> found = cells_.find_facets(surface_);
    if (std::find(found.begin(), found.end(), false) == found.end()) return false;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const Uses uses = edges_[e];
      const auto missing = std::find_if(uses.begin(), uses.end(),
                                        [&](const TriangleUse& use) { return !found[use.triangle]; });
      if (missing == uses.end() || !is_free(uses)) continue;
      if (!cells_.has_edge(missing->low, missing->high)) {
        if (!flip(uses)) split(uses);
      } else if (is_longest(*missing) && has_edges(missing->triangle)) {
        split(uses);
      }
    }
    return true;
  }

 private:
  using Uses = std::span<const TriangleUse>;
  using Edge = std::pair<std::uint32_t, std::uint32_t>;  ///< lower vertex first

  const Vector3d& at(std::uint32_t v) const { return surface_.points[v]; }
  std::uint32_t apex(const TriangleUse& use) const {
    return surface_.triangles[use.triangle][(use.corner + 2U) % 3];
  }
  bool is_free(Uses uses) const {
    return std::none_of(uses.begin(), uses.end(),
                        [this](const TriangleUse& u) { return changed_[u.triangle]; });
  }
  bool is_longest(const TriangleUse& use) const {
    const Vector3d &a = at(use.low), &b = at(use.high), &c = at(apex(use));
    return (a - b).squaredNorm() >= std::max((a - c).squaredNorm(), (b - c).squaredNorm());
  }
  bool has_edges(std::uint32_t triangle) const {
    const auto [a, b, c] = surface_.triangles[triangle];
    return cells_.has_edge(a, b) && cells_.has_edge(b, c) && cells_.has_edge(c, a);
  }
  /// Of the surface, before this round or by a flip of this round.
  bool is_edge(std::uint32_t a, std::uint32_t b) const {
    const Edge wanted = std::minmax(a, b);
    if (std::find(flipped_to_.begin(), flipped_to_.end(), wanted) != flipped_to_.end()) return true;
    std::size_t low = 0, high = edges_.size();
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      const TriangleUse& use = edges_[middle][0];
      if (Edge(use.low, use.high) < wanted)
        low = middle + 1;
      else
        high = middle;
    }
    return low < edges_.size() && Edge(edges_[low][0].low, edges_[low][0].high) == wanted;
  }

  bool flip(Uses uses) {
    if (uses.size() != 2 || uses[0].forward == uses[1].forward) return false;
    const auto [first, second] = std::pair{uses[0].triangle, uses[1].triangle};
    if (surface_.sides[first] != surface_.sides[second]) return false;
    const Triangle& t = surface_.triangles[first];
    const std::uint32_t from = t[uses[0].corner], to = t[(uses[0].corner + 1U) % 3];
    const std::uint32_t left = apex(uses[0]), right = apex(uses[1]);
    if (!cells_.has_edge(left, right) || is_edge(left, right)) return false;
    const Vector3d &a = at(from), &b = at(to), &l = at(left), &r = at(right);
    const Vector3d along = b - a, across = (r - l).cross(along);
    const bool flat = std::abs(across.dot(a - l)) <= kFlatSine * along.norm() * across.norm();
    const Vector3d normal = triangle_cross(a, b, l) + triangle_cross(b, a, r);
    if (!flat || triangle_cross(a, r, l).dot(normal) <= 0 || triangle_cross(r, b, l).dot(normal) <= 0)
      return false;
    surface_.triangles[first] = {from, right, left};
    surface_.triangles[second] = {right, to, left};
    changed_[first] = changed_[second] = true;
    flipped_to_.push_back(std::minmax(left, right));
    ++done_.flipped;
    return true;
  }

  void split(Uses uses) {
    const std::uint32_t middle = static_cast<std::uint32_t>(surface_.points.size());
    const Vector3d point = (at(uses[0].low) + at(uses[0].high)) / 2;
    if (!cells_.add(point)) return;
    surface_.points.push_back(point);
    for (const TriangleUse& use : uses) {
      Triangle half = surface_.triangles[use.triangle];
      surface_.triangles[use.triangle][(use.corner + 1U) % 3] = middle;
      half[use.corner] = middle;
      surface_.triangles.push_back(half);
      const Sides sides = surface_.sides[use.triangle];
      surface_.sides.push_back(sides);
      changed_[use.triangle] = true;
    }
    ++done_.split;
  }

  SurfaceMesh& surface_;
  DelaunayCells& cells_;
  Recovery& done_;
  EdgeGroups edges_;
  std::vector<bool> changed_;
  std::vector<Edge> flipped_to_;
};

}  // namespace

Result<Recovery> recover_surface(SurfaceMesh& surface, DelaunayCells& cells, const RunContext& ctx) {
  Recovery done;
  const std::size_t most = kAlwaysAllowed + surface.points.size() / kPointsForOne;
  for (int round = 0; round < kMostRounds && done.split <= most; ++round) {
    if (ctx.cancelled()) return cancelled_error(kTetraStage);
    if (!Round(surface, cells, done).run()) return done;
  }
  return meshing_error("the surface is too far from a Delaunay one");
}

}  // namespace voxtet::tetra
