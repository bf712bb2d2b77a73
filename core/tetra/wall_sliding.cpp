#include "tetra/wall_sliding.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "geometry/self_intersections.h"

namespace voxtet::tetra {
namespace {

constexpr int kSteps = 4;
/// Part of its shortest edge on the walls by which a vertex may move altogether.
constexpr double kReach = 0.2;
/// Part of that edge within which the label surface has to be.
constexpr double kFarthest = 0.3;

/// Within an envelope of the label surface and within reach of the start.
class Envelope : public Track {
 public:
  Envelope(const ClosestPointTree& surface, const Point& at, const Point& start, double farthest,
           double reach)
      : surface_(surface), at_(at), start_(start), farthest_(farthest), reach_(reach) {}
  Point pull(const Point& to) const override {
    const Point closest = surface_.closest(to).point;
    const double distance = (to - closest).norm();
    const Point place = distance <= farthest_ ? to : closest + (to - closest) * (farthest_ / distance);
    return (place - start_).norm() <= reach_ ? place : at_;
  }

 private:
  const ClosestPointTree& surface_;
  Point at_, start_;
  double farthest_, reach_;
};

/// As far from the label surface as at first, on the same side, and within reach of the start.
class Offset : public Track {
 public:
  Offset(const ClosestPointTree& surface, const Point& at, const Point& start, double reach)
      : surface_(surface), at_(at), start_(start), offset_(at - surface.closest(at).point), reach_(reach) {}
  Point pull(const Point& to) const override {
    const Point place = surface_.closest(to).point + offset_;
    return (place - start_).norm() <= reach_ ? place : at_;
  }

 private:
  const ClosestPointTree& surface_;
  Point at_, start_, offset_;
  double reach_;
};

/// The edges opposite to a vertex, of the triangles around it, make one closed line.
bool is_ring(std::span<const std::array<std::uint32_t, 2>> edges) {
  std::uint32_t at = edges[0][1];
  for (std::size_t step = 1; step < edges.size(); ++step) {
    const auto next = std::find_if(edges.begin(), edges.end(), [at](const auto& e) { return e[0] == at; });
    if (next == edges.end() || next == edges.begin()) return false;
    at = (*next)[1];
  }
  return at == edges[0][0];
}

}  // namespace

WallSlider::WallSlider(TetComplex& complex, VertexSmoother& smoother, const SurfaceMesh& reference,
                       const SizingField& sizing, double envelope, const WallLayers& layers)
    : complex_(complex),
      smoother_(smoother),
      reference_(reference),
      sizing_(sizing),
      envelope_(envelope),
      layers_(layers) {
  for (std::uint32_t v = 0; v < complex.point_count(); ++v) start_.push_back(complex.point(v));
}

std::optional<WallSlider::Patch> WallSlider::patch_at(std::uint32_t vertex) {
  complex_.find_star(vertex, star_);
  const Label own = complex_.label(star_[0]);
  std::optional<Label> other;
  std::vector<std::array<std::uint32_t, 2>> edges;
  Patch patch{vertex, {}, std::numeric_limits<double>::infinity(), 0};
  const Point& apex = complex_.point(vertex);
  for (const std::uint32_t t : star_) {
    if (complex_.label(t) != own) continue;
    for (std::uint32_t c = 0; c < 4; ++c) {
      const Facet facet = complex_.across(t, c);
      const Label behind = facet == kNone ? kBackground : complex_.label(tet_of(facet));
      if (complex_.corners(t)[c] == vertex || behind == own) continue;
      if (other.value_or(behind) != behind) return std::nullopt;
      other = behind;
      std::array<std::uint32_t, 3> side{};
      for (std::size_t k = 0; k < 3; ++k) side[k] = complex_.corners(t)[kSideCorners[c][k]];
      const auto at = static_cast<std::size_t>(std::find(side.begin(), side.end(), vertex) - side.begin());
      edges.push_back({side[(at + 1) % 3], side[(at + 2) % 3]});
      const Point u = complex_.point(edges.back()[0]) - apex;
      patch.shortest_edge = std::min(patch.shortest_edge, u.norm());
      patch.longest_edge = std::max(patch.longest_edge, u.norm());
    }
  }
  // Walls that are not around the star's first label, or not reached from it, make the counts differ.
  if (edges.size() != wall_count_[vertex] || !is_ring(edges)) return std::nullopt;
  patch.sides = {std::max(own, *other), std::min(own, *other)};
  return patch;
}

bool WallSlider::keeps_offset(const Sides& sides) const {
  const bool of_layers = layers_.is_layer(sides[0]) || layers_.is_layer(sides[1]);
  return of_layers && layers_.parent(sides[0]) != layers_.parent(sides[1]);
}

std::size_t WallSlider::slide_patches(std::span<const Patch> patches, double enough,
                                      std::span<std::uint8_t> moved) {
  std::vector<BoundaryPlace> places;
  double longest = 0;
  for (const Patch& patch : patches) {
    places.push_back({complex_.point(patch.vertex), patch.sides});
    longest = std::max(longest, patch.longest_edge);
  }
  const NearbySurface nearby(reference_, places, (kReach + kFarthest) * longest);
  std::size_t count = 0;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const Patch& patch = patches[p];
    const ClosestPointTree* surface = nearby.between(patch.sides);
    if (surface == nullptr) continue;
    const Point& at = complex_.point(patch.vertex);
    const double distance = surface->closest(at).distance_mm;
    if (distance > kFarthest * patch.shortest_edge) continue;
    const double reach = kReach * patch.shortest_edge;
    const Envelope envelope(*surface, at, start_[patch.vertex],
                            std::max(distance, envelope_ * sizing_.at(at)), reach);
    const Offset offset(*surface, at, start_[patch.vertex], reach);
    const Track& track = keeps_offset(patch.sides) ? static_cast<const Track&>(offset) : envelope;
    moved[p] = smoother_.smooth(patch.vertex, enough, kSteps, &track);
    count += moved[p];
  }
  return count;
}

bool WallSlider::walls_meet(std::span<const Patch> patches, std::span<const std::uint8_t> moved) const {
  std::vector<std::uint8_t> away(complex_.point_count(), 0);
  for (std::size_t p = 0; p < patches.size(); ++p) away[patches[p].vertex] = moved[p];
  SurfaceMesh walls{{}, complex_.walls(), complex_.wall_sides()};
  for (std::uint32_t v = 0; v < wall_count_.size(); ++v) walls.points.push_back(complex_.point(v));
  std::vector<std::uint8_t> concerned;
  for (const auto& [a, b, c] : walls.triangles) concerned.push_back(away[a] | away[b] | away[c]);
  return !SelfIntersectionTree(walls).find(concerned, 1).empty();
}

std::size_t WallSlider::slide(std::span<const std::uint32_t> vertices, double enough) {
  wall_count_.assign(start_.size(), 0);
  for (const Triangle& wall : complex_.walls())
    for (const std::uint32_t v : wall) ++wall_count_[v];
  std::vector<Patch> patches;
  std::vector<Point> before;
  for (const std::uint32_t v : vertices)
    if (const std::optional<Patch> patch = patch_at(v)) {
      patches.push_back(*patch);
      before.push_back(complex_.point(v));
    }
  std::vector<std::uint8_t> moved(patches.size(), 0);
  const std::size_t count = slide_patches(patches, enough, moved);
  if (count == 0 || !walls_meet(patches, moved)) return count;
  for (std::size_t p = patches.size(); p-- > 0;) {
    if (!moved[p]) continue;
    complex_.find_star(patches[p].vertex, star_);
    complex_.move_point(patches[p].vertex, before[p], star_);
  }
  return 0;
}

}  // namespace voxtet::tetra
