#include "tetra/interfaces/interface_sliding.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "geometry/intersect/self_intersections.h"

namespace voxtet::tetra {
namespace {

constexpr int kSteps = 4;
/// Part of its shortest edge on the interfaces by which a vertex may move altogether.
constexpr double kReach = 0.2;
/// Part of that edge within which the label surface has to be, where it is not in the envelope.
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

/// The interfaces at a vertex, given by their other two corners, hang together by edges.
bool is_connected(std::vector<std::array<std::uint32_t, 2>> interfaces) {
  if (interfaces.empty()) return false;
  std::size_t reached = 1;
  for (std::size_t next = 0; next < reached; ++next)
    for (std::size_t w = reached; w < interfaces.size(); ++w)
      for (const std::uint32_t v : interfaces[w])
        if (v == interfaces[next][0] || v == interfaces[next][1]) {
          std::swap(interfaces[w], interfaces[reached++]);
          break;
        }
  return reached == interfaces.size();
}

}  // namespace

InterfaceSlider::InterfaceSlider(TetComplex& complex, VertexSmoother& smoother, const SurfaceMesh& reference,
                                 const SizingField& sizing, double envelope, const WallLayers& layers,
                                 const CutPlanes& cuts, const VolumeKeeper& volumes)
    : complex_(complex),
      smoother_(smoother),
      reference_(reference),
      sizing_(sizing),
      envelope_(envelope),
      layers_(layers),
      cuts_(cuts),
      volumes_(volumes) {
  for (std::uint32_t v = 0; v < complex.point_count(); ++v) start_.push_back(complex.point(v));
  held_.assign(start_.size(), 0);
}

std::optional<InterfaceSlider::Seat> InterfaceSlider::seat_of(std::uint32_t vertex) {
  complex_.find_star(vertex, seen_, star_);
  std::vector<Sides> kind;
  std::vector<std::array<std::uint32_t, 2>> interfaces;  // their other corners
  std::vector<std::pair<std::uint32_t, Sides>> uses;     // of the edges to them
  Seat seat{{}, std::numeric_limits<double>::infinity(), 0};
  for (const std::uint32_t t : star_)
    for (std::uint32_t c = 0; c < 4; ++c) {
      if (complex_.corners(t)[c] == vertex || complex_.behind(t, c) != kNone) continue;
      const Facet facet = complex_.across(t, c);
      const Label behind = facet == kNone ? kBackground : complex_.label(tet_of(facet));
      if (behind > complex_.label(t)) continue;  // met from its other side
      kind.push_back({complex_.label(t), behind});
      std::array<std::uint32_t, 2> others{};
      std::size_t count = 0;
      for (const std::uint32_t k : kFacetCorners[c])
        if (const std::uint32_t v = complex_.corners(t)[k]; v != vertex) {
          others[count++] = v;
          uses.emplace_back(v, kind.back());
          const double length = (complex_.point(v) - complex_.point(vertex)).norm();
          seat.shortest_edge = std::min(seat.shortest_edge, length);
          seat.longest_edge = std::max(seat.longest_edge, length);
        }
      interfaces.push_back(others);
    }
  // Interfaces that are not reached from the star's first tet make the counts differ.
  if (interfaces.size() != interface_count_[vertex] || !is_connected(interfaces)) return std::nullopt;
  seat.kind = ascending(std::move(kind));
  std::sort(uses.begin(), uses.end());
  std::size_t ends = 0;  // of the curve
  for (auto use = uses.begin(); use != uses.end();) {
    BoundaryKind at_edge;
    const std::uint32_t v = use->first;
    std::size_t count = 0;
    for (; use != uses.end() && use->first == v; ++use, ++count) at_edge.push_back(use->second);
    if (count == 2) continue;
    if (ascending(std::move(at_edge)) != seat.kind) return std::nullopt;
    ++ends;
  }
  if (ends != (seat.kind.size() == 1 ? 0 : 2)) return std::nullopt;
  if (ends > 0 && is_of_layers(seat.kind)) return std::nullopt;
  return seat;
}

bool InterfaceSlider::is_of_layers(const BoundaryKind& kind) const {
  return std::any_of(kind.begin(), kind.end(), [this](const Sides& sides) {
    return layers_.is_layer(sides[0]) || layers_.is_layer(sides[1]);
  });
}

bool InterfaceSlider::keeps_offset(const BoundaryKind& kind) const {
  if (is_of_layers(kind)) return layers_.parent(kind[0][0]) != layers_.parent(kind[0][1]);
  return !std::all_of(kind.begin(), kind.end(), [this](const Sides& sides) {
    return !is_beyond(cuts_, sides[0]) && volumes_.allows(sides[0], volumes_.off_mm3(sides[0])) &&
           volumes_.allows(sides[1], volumes_.off_mm3(sides[1]));
  });
}

void InterfaceSlider::approach(std::span<const std::uint32_t> vertices) {
  interface_count_.assign(start_.size(), 0);
  for (const Triangle& interface : complex_.interfaces())
    for (const std::uint32_t v : interface) ++interface_count_[v];
  std::vector<BoundaryPlace> places;
  double reach = 0;
  for (const std::uint32_t v : vertices)
    if (std::optional<Seat> seat = seat_of(v)) {
      const Point& at = complex_.point(v);
      places.push_back({at, std::move(seat->kind)});
      reach = std::max({reach, (freedom_ * kReach + kFarthest) * seat->longest_edge,
                        freedom_ * (kReach * seat->longest_edge + envelope_ * sizing_.at(at))});
    }
  nearby_.emplace(reference_, places, reach);
}

bool InterfaceSlider::slide(std::uint32_t vertex, double enough, double most_misfit) {
  const std::optional<Seat> seat = nearby_ && !held_[vertex] ? seat_of(vertex) : std::nullopt;
  const ClosestPointTree* surface = seat ? nearby_->of(seat->kind) : nullptr;
  if (surface == nullptr) return false;
  const Point at = complex_.point(vertex);
  const double distance = surface->closest(at).distance_mm, allowed = freedom_ * envelope_ * sizing_.at(at);
  if (distance > std::max(kFarthest * seat->shortest_edge, allowed)) return false;
  const double reach = freedom_ * kReach * seat->shortest_edge;
  const Envelope envelope(*surface, at, start_[vertex], std::max(distance, allowed), reach);
  const Offset offset(*surface, at, start_[vertex], reach);
  const Track& track = keeps_offset(seat->kind) ? static_cast<const Track&>(offset) : envelope;
  std::vector<double> off;
  for (const auto& [own, other] : seat->kind) {
    off.push_back(volumes_.off_mm3(own));
    off.push_back(volumes_.off_mm3(other));
  }
  if (!smoother_.smooth(vertex, enough, kSteps, &track, most_misfit)) return false;
  auto was_off = off.begin();
  bool allowed_by_volumes = true;
  for (const auto& sides : seat->kind)
    for (const Label label : sides)
      allowed_by_volumes &= volumes_.allows(label, volumes_.off_mm3(label), *was_off++);
  if (!allowed_by_volumes) complex_.move_point(vertex, at, star_);
  return allowed_by_volumes;
}

bool InterfaceSlider::hold_where_interfaces_meet(const TetComplex::Mark& since) {
  std::vector<std::uint8_t> away(complex_.point_count(), 0);
  bool any = false;
  for (const TetComplex::Change& change : complex_.changes_since(since)) {
    if (change.moved == kNone || !complex_.on_interface(change.moved)) continue;
    away[change.moved] = 1;
    any = true;
  }
  if (!any) return false;
  SurfaceMesh interfaces{{}, complex_.interfaces(), complex_.interface_sides()};
  for (std::uint32_t v = 0; v < start_.size(); ++v) interfaces.points.push_back(complex_.point(v));
  std::vector<std::uint8_t> concerned;
  for (const auto& [a, b, c] : interfaces.triangles) concerned.push_back(away[a] | away[b] | away[c]);
  const std::vector<TrianglePair> meeting = SelfIntersectionTree(interfaces).find(concerned);
  for (const TrianglePair& pair : meeting)
    for (const std::uint32_t t : pair)
      for (const std::uint32_t v : interfaces.triangles[t]) held_[v] = 1;
  return !meeting.empty();
}

}  // namespace voxtet::tetra
