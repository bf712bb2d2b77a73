#include <algorithm>
#include <map>
#include <utility>

#include "anatomy/name_faces.h"
#include "anatomy/nearest_faces.h"
#include "anatomy/surface_parts.h"
#include "base/union_find.h"

namespace voxtet::anatomy {
namespace {

constexpr double kSquaredCosine = 0.5;  ///< of 45 degrees
constexpr double kEvenCosine = 0.77;    ///< of 40 degrees: the turn of an edge that is no crease
constexpr double kLeastOpening = 0.2;   ///< of the longest border of an opening
constexpr int kGrowthRounds = 5;

bool is_inner(std::uint8_t kind) {
  return kind >= wall::kInner;
}

/// Points of the faces of whose kinds `wanted` approves.
template <class Wanted>
std::vector<bool> points_of(std::size_t point_count, const WallSurface& surface, const FaceKinds& kinds,
                            Wanted&& wanted) {
  std::vector<bool> of(point_count, false);
  for (std::size_t f = 0; f < kinds.size(); ++f)
    if (wanted(kinds[f]))
      for (const std::uint32_t v : surface.faces[f].corners) of[v] = true;
  return of;
}

bool touches(const Triangle& corners, const std::vector<bool>& points) {
  return points[corners[0]] || points[corners[1]] || points[corners[2]];
}

/// The points where an inner surface ends, and those one edge inwards.
std::vector<bool> near_border(std::size_t point_count, const WallSurface& surface, const FaceKinds& kinds) {
  const std::vector<bool> outer =
      points_of(point_count, surface, kinds, [](std::uint8_t kind) { return !is_inner(kind); });
  std::vector<bool> near(point_count, false);
  for (std::size_t f = 0; f < kinds.size(); ++f)
    if (is_inner(kinds[f]) && touches(surface.faces[f].corners, outer))
      for (const std::uint32_t v : surface.faces[f].corners) near[v] = true;
  return near;
}

/// Outer faces that lie beside, not before, the nearest of the inner surfaces, which is near its border.
std::vector<bool> may_be_rim(const Points& points, const WallSurface& surface, int threads,
                             const FaceKinds& kinds) {
  std::vector<bool> may(kinds.size(), false);
  const std::vector<Triangle> inner = triangles_of(surface, kinds, is_inner);
  if (inner.empty()) return may;
  const auto is_outer = [](std::uint8_t kind) { return kind == wall::kOuter; };
  const std::vector<bool> near = near_border(points.size(), surface, kinds);
  const std::vector<ClosestPointTree::Hit> nearest =
      closest_to_faces({points, inner}, surface, kinds, threads, is_outer);
  for (std::size_t f = 0; f < kinds.size(); ++f) {
    if (!is_outer(kinds[f])) continue;
    const Triangle& corners = inner[nearest[f].triangle];
    if (!std::all_of(corners.begin(), corners.end(), [&](std::uint32_t v) { return near[v]; })) continue;
    const Eigen::Vector3d way = surface.faces[f].centre - nearest[f].point;
    const double along = way.dot(surface.faces[f].normal);
    may[f] = along <= 0 || along * along < kSquaredCosine * way.squaredNorm();
  }
  return may;
}

/// The points of edges where the inner surfaces end, but for holes in the wall.
std::vector<bool> borders_of_openings(std::size_t point_count, const WallSurface& surface,
                                      const FaceKinds& kinds) {
  UnionFind joined(point_count);
  std::vector<std::pair<std::uint32_t, double>> edges;  // one of the points, length
  for (const Contact& contact : surface.contacts) {
    if (is_inner(kinds[contact.a]) == is_inner(kinds[contact.b])) continue;
    const auto [p, q] = contact.edge;
    joined.join(p, q);
    edges.emplace_back(p, contact.length_mm);
  }
  std::vector<double> length(point_count, 0);
  double longest = 0;
  for (const auto& [point, mm] : edges) longest = std::max(longest, length[joined.find(point)] += mm);
  std::vector<bool> large(point_count, false);
  for (std::uint32_t v = 0; v < point_count; ++v)
    large[v] = length[joined.find(v)] > 0 && length[joined.find(v)] >= kLeastOpening * longest;
  return large;
}

bool is_even(const WallSurface& surface, const Contact& contact) {
  return surface.faces[contact.a].normal.dot(surface.faces[contact.b].normal) > kEvenCosine;
}

/// Turns faces that may be of the rim into kSide, from the openings on, but not across creases.
void grow_rim(std::size_t point_count, const WallSurface& surface, const std::vector<bool>& may,
              FaceKinds& kinds) {
  UnionFind joined(kinds.size());
  for (const Contact& contact : surface.contacts)
    if (may[contact.a] && may[contact.b] && is_even(surface, contact)) joined.join(contact.a, contact.b);
  const std::vector<bool> borders = borders_of_openings(point_count, surface, kinds);
  std::vector<bool> begins(kinds.size(), false);
  for (std::uint32_t f = 0; f < kinds.size(); ++f)
    if (may[f] && touches(surface.faces[f].corners, borders)) begins[joined.find(f)] = true;
  for (std::uint32_t f = 0; f < kinds.size(); ++f)
    if (may[f] && begins[joined.find(f)]) kinds[f] = wall::kSide;
}

/// Faces between rim and outer surface go with the longer part of their even edges. Those at the inner
/// surfaces stay as they are: the rim of a thin wall is one face wide.
void even_out(std::size_t point_count, const WallSurface& surface, FaceKinds& kinds) {
  const std::vector<bool> inner = points_of(point_count, surface, kinds, is_inner);
  for (int round = 0; round < kGrowthRounds; ++round) {
    std::vector<double> rim_mm(kinds.size(), 0);  // minus what leads to the outer surface
    for (const Contact& contact : surface.contacts) {
      if (!is_even(surface, contact)) continue;
      for (const auto& [to, from] : {std::pair(contact.a, contact.b), std::pair(contact.b, contact.a)}) {
        if (kinds[from] == wall::kSide) rim_mm[to] += contact.length_mm;
        if (kinds[from] == wall::kOuter) rim_mm[to] -= contact.length_mm;
      }
    }
    for (std::size_t f = 0; f < kinds.size(); ++f) {
      if (touches(surface.faces[f].corners, inner)) continue;
      if (kinds[f] == wall::kOuter && rim_mm[f] > 0)
        kinds[f] = wall::kSide;
      else if (kinds[f] == wall::kSide && rim_mm[f] < 0)
        kinds[f] = wall::kOuter;
    }
  }
}

/// Where an inner surface is several fans of faces around a point, its rims would meet there: all but the
/// largest become rim.
void part_rims(const WallSurface& surface, FaceKinds& kinds) {
  const auto corner_at = [&](std::uint32_t face, std::uint32_t point) {
    const Triangle& corners = surface.faces[face].corners;
    return 3 * face +
           static_cast<std::uint32_t>(std::find(corners.begin(), corners.end(), point) - corners.begin());
  };
  for (bool any = true; std::exchange(any, false);) {
    UnionFind fans(3 * kinds.size());  // of corners of faces
    for (const Contact& contact : surface.contacts)
      if (kinds[contact.a] == kinds[contact.b])
        for (const std::uint32_t point : contact.edge)
          fans.join(corner_at(contact.a, point), corner_at(contact.b, point));
    std::vector<double> areas(3 * kinds.size(), 0);
    for (std::uint32_t c = 0; c < areas.size(); ++c) areas[fans.find(c)] += surface.faces[c / 3].area_mm2;
    std::map<std::pair<std::uint32_t, std::uint8_t>, std::uint32_t> largest;  // by point and kind
    const auto largest_at = [&](std::uint32_t c) -> std::uint32_t& {
      return largest.try_emplace({surface.faces[c / 3].corners[c % 3], kinds[c / 3]}, fans.find(c))
          .first->second;
    };
    for (std::uint32_t c = 0; c < areas.size(); ++c)
      if (is_inner(kinds[c / 3]))
        if (std::uint32_t& fan = largest_at(c); areas[fans.find(c)] > areas[fan]) fan = fans.find(c);
    std::vector<std::uint32_t> apart;
    for (std::uint32_t c = 0; c < areas.size(); ++c)
      if (is_inner(kinds[c / 3]) && largest_at(c) != fans.find(c)) apart.push_back(c / 3);
    for (const std::uint32_t face : apart) kinds[face] = wall::kSide;
    any = !apart.empty();
  }
}

}  // namespace

void find_base(const Points& points, const WallSurface& surface, int threads, FaceKinds& kinds) {
  grow_rim(points.size(), surface, may_be_rim(points, surface, threads, kinds), kinds);
  even_out(points.size(), surface, kinds);
  const SurfaceParts parts = surface_parts(surface, kinds);
  std::vector<Fate> fates = largest_stay(parts);
  const std::vector<bool> inner = points_of(points.size(), surface, kinds, is_inner);
  for (std::size_t f = 0; f < kinds.size(); ++f)
    if (kinds[f] == wall::kSide && touches(surface.faces[f].corners, inner))
      fates[parts.of[f]] = Fate::kStays;
  give_away(surface, parts, fates, wall::kWall, kinds);
  part_rims(surface, kinds);
}

}  // namespace voxtet::anatomy
