#include "tetra/interfaces/interface_flipping.h"

#include <algorithm>
#include <set>

#include "geometry/elements/triangle_measures.h"
#include "tetra/operations/local_swaps.h"

namespace voxtet::tetra {
namespace {

/// New triangles may have angles down to this, or to the smallest of the old ones.
constexpr double kLeastAngleDeg = 25;

}  // namespace

std::optional<InterfaceFlipper::Candidate> InterfaceFlipper::candidate_at(std::uint32_t t) const {
  if (!complex_.alive(t)) return std::nullopt;
  Candidate candidate{t, kBackground, {}, {}, {}};
  int interfaces = 0;
  for (std::uint32_t c = 0; c < 4; ++c) {
    if (complex_.behind(t, c) != kNone) continue;
    const Facet facet = complex_.across(t, c);
    const Label behind = facet == kNone ? kBackground : complex_.label(tet_of(facet));
    if (interfaces > 0 && behind != candidate.other) return std::nullopt;
    candidate.other = behind;
    candidate.interface[c] = true;
    ++interfaces;
  }
  if (interfaces != 2 && interfaces != 3) return std::nullopt;
  // Two interfaces share the edge opposite to that of the other two sides; the fourth side of three
  // interfaces is that of the corners that are opposite to them.
  const auto middle_of_corners = [&](bool opposite_to_interface) {
    Point sum = Point::Zero();
    int count = 0;
    for (std::uint32_t c = 0; c < 4; ++c)
      if (candidate.interface[c] == opposite_to_interface) {
        sum += complex_.point(complex_.corners(t)[c]);
        ++count;
      }
    return Point(sum / count);
  };
  candidate.new_middle = middle_of_corners(true);
  candidate.old_middle = middle_of_corners(false);
  return candidate;
}

bool InterfaceFlipper::only_other_around(const Candidate& candidate, std::span<const std::uint32_t> corners) {
  const Tet& own = complex_.corners(candidate.t);
  complex_.find_star(own[corners[0]], seen_, star_);
  for (const std::uint32_t t : star_) {
    if (t == candidate.t) continue;
    const bool at_all = std::all_of(corners.begin(), corners.end(),
                                    [&](std::uint32_t c) { return complex_.corner_at(t, own[c]) < 4; });
    if (!at_all) continue;
    if (complex_.label(t) != candidate.other) return false;
    for (std::uint32_t side = 0; side < 4; ++side) {
      const bool at_side = std::none_of(corners.begin(), corners.end(),
                                        [&](std::uint32_t c) { return complex_.corners(t)[side] == own[c]; });
      if (at_side && complex_.across(t, side) == kNone) return false;
    }
  }
  return true;
}

bool InterfaceFlipper::keeps_topology(const Candidate& candidate) {
  std::array<std::uint32_t, 4>
      kept{};  // corners whose opposite side is no interface: those of the old edge or tip
  std::size_t count = 0;
  std::array<std::uint32_t, 2> new_edge{};
  std::size_t ends = 0;
  for (std::uint32_t c = 0; c < 4; ++c) {
    if (!candidate.interface[c])
      kept[count++] = c;
    else if (ends < 2)
      new_edge[ends++] = c;
  }
  // The old edge, or the tip, comes to lie inside of the other label.
  if (!only_other_around(candidate, {kept.data(), count})) return false;
  // The new edge must lie inside of the own label. (A tip's triangle is there already.)
  EdgeRing ring;
  return count == 1 || complex_.find_ring(candidate.t, new_edge[0], new_edge[1], ring);
}

bool InterfaceFlipper::keeps_angles(const Candidate& candidate) const {
  const Tet& own = complex_.corners(candidate.t);
  double before = 180, after = 180;
  for (std::uint32_t c = 0; c < 4; ++c) {
    const auto& side = kFacetCorners[c];
    const double angle = measure_triangle({complex_.point(own[side[0]]), complex_.point(own[side[1]]),
                                           complex_.point(own[side[2]])})
                             .min_angle_deg;
    double& least = candidate.interface[c] ? before : after;
    least = std::min(least, angle);
  }
  return after >= std::min(before, kLeastAngleDeg);
}

InterfaceExchange InterfaceFlipper::exchange_of(const Candidate& candidate) const {
  InterfaceExchange exchange;
  const Tet& own = complex_.corners(candidate.t);
  for (std::uint32_t c = 0; c < 4; ++c) {
    const auto& side = kFacetCorners[c];
    const Triangle triangle{own[side[0]], own[side[1]], own[side[2]]};
    (candidate.interface[c] ? exchange.gone : exchange.made).push_back(triangle);
  }
  // Seen from the tet, the new interfaces face the other way.
  for (Triangle& triangle : exchange.made) std::swap(triangle[1], triangle[2]);
  return exchange;
}

std::size_t InterfaceFlipper::flip(std::span<const std::uint32_t> tets) {
  std::vector<Candidate> candidates;
  std::vector<BoundaryPlace> places;
  double reach = 0;
  for (const std::uint32_t t : tets)
    if (const std::optional<Candidate> candidate = candidate_at(t)) {
      candidates.push_back(*candidate);
      const Label own = complex_.label(t);
      places.push_back(
          {candidate->new_middle, {{std::max(own, candidate->other), std::min(own, candidate->other)}}});
      reach = std::max({reach, envelope_ * sizing_.at(candidate->new_middle),
                        2 * (candidate->new_middle - candidate->old_middle).norm()});
    }
  if (candidates.empty()) return 0;
  const NearbySurface nearby(reference_, places, reach);
  std::vector<InterfaceExchange> exchanges;
  std::set<Triangle> fresh;  // interfaces that complex_ does not list yet
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const ClosestPointTree* surface = nearby.of(places[i].kind);
    if (surface == nullptr) continue;
    // What went before may have changed it.
    const std::optional<Candidate> candidate = candidate_at(candidates[i].t);
    if (!candidate || candidate->interface != candidates[i].interface ||
        candidate->new_middle != places[i].at)
      continue;
    const double allowed = std::max(surface->closest(candidate->old_middle).distance_mm,
                                    envelope_ * sizing_.at(candidate->new_middle));
    if (surface->closest(candidate->new_middle).distance_mm > allowed) continue;
    if (!keeps_angles(*candidate) || !keeps_topology(*candidate)) continue;
    InterfaceExchange exchange = exchange_of(*candidate);
    const auto is_fresh = [&](const Triangle& interface) { return fresh.count(ascending(interface)) > 0; };
    if (std::any_of(exchange.gone.begin(), exchange.gone.end(), is_fresh)) continue;
    const Label own = complex_.label(candidate->t);
    const double mm3 = complex_.tet_volume_mm3(candidate->t);
    const auto allows = [this](Label label, double gain_mm3) {
      return volumes_.allows(label, volumes_.off_mm3(label, gain_mm3), volumes_.off_mm3(label));
    };
    if (!allows(own, -mm3) || !allows(candidate->other, mm3)) continue;
    complex_.relabel(candidate->t, candidate->other);
    if (candidate->other != kBackground && swap_at(complex_, candidate->t, guard_) == Swap::kNone) {
      complex_.relabel(candidate->t, own);
      continue;
    }
    for (const Triangle& interface : exchange.made) fresh.insert(ascending(interface));
    exchanges.push_back(std::move(exchange));
  }
  complex_.exchange_interfaces(exchanges);
  return exchanges.size();
}

}  // namespace voxtet::tetra
