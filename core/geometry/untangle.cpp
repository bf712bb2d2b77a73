#include "geometry/untangle.h"

#include <limits>

#include "geometry/self_intersections.h"

namespace voxtet {
namespace {

using Flags = std::vector<std::uint8_t>;

constexpr int kHalvings = 4;       ///< after which a point goes all the way
constexpr int kRoundsPerRing = 3;  ///< the neighbourhood grows by a ring of triangles after so many rounds

/// Triangles with a flagged corner.
void flag_triangles(const SurfaceMesh& surface, const Flags& points, Flags& triangles) {
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Triangle& v = surface.triangles[t];
    triangles[t] = points[v[0]] | points[v[1]] | points[v[2]];
  }
}

void flag_corners(const SurfaceMesh& surface, const Flags& triangles, Flags& points) {
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (triangles[t])
      for (const std::uint32_t v : surface.triangles[t]) points[v] = 1;
}

}  // namespace

UntangleOutcome untangle(SurfaceMesh& surface, const std::vector<Eigen::Vector3d>& start,
                         const RunContext& ctx) {
  UntangleOutcome outcome;
  std::vector<Eigen::Vector3d>& points = surface.points;
  Flags moved(points.size()), concerned(surface.triangles.size());
  std::vector<int> halvings(points.size(), 0);
  for (std::size_t v = 0; v < points.size(); ++v) moved[v] = points[v] != start[v];
  flag_triangles(surface, moved, concerned);
  SelfIntersectionTree tree(surface, ctx.threads);
  for (;; ++outcome.rounds) {
    outcome.cancelled = ctx.cancelled();
    if (outcome.cancelled) return outcome;
    const std::vector<TrianglePair> pairs = tree.find(concerned, std::numeric_limits<std::size_t>::max());
    if (pairs.empty()) return outcome;
    concerned.assign(concerned.size(), 0);
    for (const TrianglePair& pair : pairs)
      for (const std::uint32_t t : pair) concerned[t] = 1;
    moved.assign(moved.size(), 0);
    flag_corners(surface, concerned, moved);
    for (int ring = 0; ring < outcome.rounds / kRoundsPerRing; ++ring) {
      flag_triangles(surface, moved, concerned);
      flag_corners(surface, concerned, moved);
    }
    for (std::size_t v = 0; v < points.size(); ++v) {
      moved[v] = moved[v] && points[v] != start[v];
      if (!moved[v]) continue;
      outcome.moved_back += halvings[v] == 0 ? 1 : 0;
      points[v] = ++halvings[v] > kHalvings ? start[v] : Eigen::Vector3d(0.5 * (points[v] + start[v]));
    }
    flag_triangles(surface, moved, concerned);
  }
}

}  // namespace voxtet
