#include "geometry/repair/retreat.h"

#include "base/parallel.h"

namespace voxtet {
namespace {

constexpr int kHalvings = 4;
constexpr int kStepsPerRing = 3;

}  // namespace

Retreat::Retreat(const std::vector<Triangle>& triangles, const std::vector<Eigen::Vector3d>& start,
                 std::vector<Eigen::Vector3d>& points, int threads)
    : triangles_(triangles), start_(start), points_(points), threads_(threads), halvings_(points.size(), 0) {}

Flags Retreat::displaced() const {
  Flags away(points_.size());
  for (std::size_t v = 0; v < away.size(); ++v) away[v] = points_[v] != start_[v];
  return triangles_at(away);
}

void Retreat::step(Flags& flagged) {
  Flags moved = corners_of(flagged);
  for (int ring = 0; ring < steps_ / kStepsPerRing; ++ring) moved = corners_of(triangles_at(moved));
  for (std::size_t v = 0; v < points_.size(); ++v) {
    moved[v] = moved[v] && points_[v] != start_[v];
    if (!moved[v]) continue;
    if (halvings_[v] == 0) ++moved_back_;
    if (halvings_[v] == kHalvings) {
      points_[v] = start_[v];
    } else {
      ++halvings_[v];
      points_[v] = 0.5 * (points_[v] + start_[v]);
    }
  }
  flagged = triangles_at(moved);
  ++steps_;
}

Flags Retreat::corners_of(const Flags& flagged) const {
  Flags corners(points_.size(), 0);
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    if (flagged[t])
      for (const std::uint32_t v : triangles_[t]) corners[v] = 1;
  return corners;
}

Flags Retreat::triangles_at(const Flags& moved) const {
  Flags flagged(triangles_.size());
  parallel_for(threads_, triangles_.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      const Triangle& v = triangles_[t];
      flagged[t] = moved[v[0]] | moved[v[1]] | moved[v[2]];
    }
  });
  return flagged;
}

}  // namespace voxtet
