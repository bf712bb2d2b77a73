#include "tetra/fill/check_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "geometry/elements/edge_turn.h"
#include "geometry/intersect/self_intersections.h"
#include "tetra/mesh/meshing_error.h"

namespace voxtet {
namespace {

/// Relative to the bounding box.
constexpr double kCoinciding = 1e-6;
/// Of a tenth of a degree.
constexpr double kNarrowCosine = 0.99999847691328769;
constexpr double kDegreesPerRadian = 57.295779513082321;

/// Twice the area over the longest side squared, below which a triangle counts as degenerate.
constexpr double kFlat = 1e-10;

bool is_flat(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return !((b - a).cross(c - a).norm() > kFlat * longest);
}

double degrees_of(double cosine) {
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * kDegreesPerRadian;
}

double corner_cosine(const SurfaceMesh& surface, std::uint32_t t, std::size_t corner) {
  const Triangle& v = surface.triangles[t];
  const Eigen::Vector3d& apex = surface.points[v[corner]];
  return (surface.points[v[(corner + 1) % 3]] - apex)
      .normalized()
      .dot((surface.points[v[(corner + 2) % 3]] - apex).normalized());
}

/// Calls visit(cosine, use, other) for every two triangles at an edge: the angle between them, the use of one
/// and the index of the other.
template <class Visit>
void for_each_dihedral(const SurfaceMesh& surface, const EdgeGroups& edges, Visit&& visit) {
  std::vector<Eigen::Vector3d> away;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const TriangleUse& first = edges[e][0];
    const Eigen::Vector3d& low = surface.points[first.low];
    const Eigen::Vector3d axis = (surface.points[first.high] - low).normalized();
    away.clear();
    for (const TriangleUse& use : edges[e]) {
      const Eigen::Vector3d arm = surface.points[surface.triangles[use.triangle][(use.corner + 2) % 3]] - low;
      away.push_back((arm - axis * axis.dot(arm)).normalized());
    }
    for (std::size_t i = 0; i < away.size(); ++i)
      for (std::size_t j = i + 1; j < away.size(); ++j)
        visit(away[i].dot(away[j]), edges[e][i], edges[e][j].triangle);
  }
}

/// Edges at which something is wrong: how many, and where the first ones are.
struct EdgeFaults {
  std::size_t count = 0;
  ErrorPlace where;  ///< triangles at the edges and the edges' midpoints

  void add(const SurfaceMesh& surface, std::span<const TriangleUse> uses) {
    if (++count > kMaxPlaces) return;
    for (const TriangleUse& use : uses) where.elements.push_back(use.triangle);
    where.points.push_back((surface.points[uses[0].low] + surface.points[uses[0].high]) / 2);
  }
  /// None is no error.
  Status status(const std::string& before, const std::string& after) && {
    if (count == 0) return std::monostate{};
    std::sort(where.elements.begin(), where.elements.end());
    where.elements.erase(std::unique(where.elements.begin(), where.elements.end()), where.elements.end());
    return meshing_error(before + std::to_string(count) + after, std::move(where));
  }
};

/// A triangle at an edge, seen along it: its angle, and the labels before and after it as the angle grows.
struct Wing {
  double turn = 0;  ///< EdgeTurn
  Label before = kBackground, after = kBackground;
};

/// The triangles at an edge in the order of their angles.
void wings_around(const SurfaceMesh& surface, std::span<const TriangleUse> uses, std::vector<Wing>& wings) {
  const auto apex = [&](const TriangleUse& use) -> const Eigen::Vector3d& {
    return surface.points[surface.triangles[use.triangle][(use.corner + 2) % 3]];
  };
  const EdgeTurn turn(surface.points[uses[0].low], surface.points[uses[0].high], apex(uses[0]));
  wings.clear();
  for (const TriangleUse& use : uses) {
    const Sides& sides = surface.sides[use.triangle];
    wings.push_back({turn(apex(use)), sides[use.forward ? 0 : 1], sides[use.forward ? 1 : 0]});
  }
  std::sort(wings.begin(), wings.end(), [](const Wing& a, const Wing& b) { return a.turn < b.turn; });
}

/// Points with another one within kCoinciding of the bounding box's largest side.
std::vector<bool> nearly_coinciding(const std::vector<Eigen::Vector3d>& points) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return points[a].x() != points[b].x() ? points[a].x() < points[b].x() : a < b;
  });
  Eigen::Vector3d low = points[0], high = points[0];
  for (const Eigen::Vector3d& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const double reach = kCoinciding * (high - low).maxCoeff();
  std::vector<bool> close(points.size(), false);
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && points[order[j]].x() - points[order[i]].x() <= reach; ++j)
      if ((points[order[j]] - points[order[i]]).squaredNorm() <= reach * reach)
        close[order[i]] = close[order[j]] = true;
  return close;
}

}  // namespace

Status check_triangles(const SurfaceMesh& surface) {
  const std::size_t n = surface.points.size();
  if (surface.triangles.empty()) return meshing_error("the surface has no triangle");
  if (surface.sides.size() != surface.triangles.size())
    return meshing_error("the surface has " + std::to_string(surface.triangles.size()) + " triangles but " +
                         std::to_string(surface.sides.size()) + " pairs of sides");
  for (const Eigen::Vector3d& p : surface.points)
    if (!p.allFinite()) return meshing_error("a point of the surface is not finite");

  std::vector<bool> used(n, false);
  std::vector<bool> flat(surface.triangles.size(), false);
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const auto [a, b, c] = surface.triangles[t];
    if (a >= n || b >= n || c >= n)
      return meshing_error(
          "triangle " + std::to_string(t) + " names a point beyond the " + std::to_string(n) + " there are",
          {{}, {t}});
    if (surface.sides[t][0] <= surface.sides[t][1])
      return meshing_error("triangle " + std::to_string(t) + " has sides " +
                               std::to_string(surface.sides[t][0]) + " and " +
                               std::to_string(surface.sides[t][1]) + "; the first must be the larger",
                           {{}, {t}});
    used[a] = used[b] = used[c] = true;
    if (a != b && b != c && c != a && !is_flat(surface.points[a], surface.points[b], surface.points[c]))
      continue;
    flat[t] = true;
  }
  if (FaultyTriangles found(surface, flat); found.count > 0)
    return meshing_error(std::to_string(found.count) + " triangles of the surface have no area",
                         std::move(found.where));
  const auto unused = std::find(used.begin(), used.end(), false);
  if (unused != used.end())
    return meshing_error(
        "point " + std::to_string(unused - used.begin()) + " of the surface belongs to no triangle",
        {{surface.points[static_cast<std::size_t>(unused - used.begin())]}, {}});
  return std::monostate{};
}

Status check_closed(const SurfaceMesh& surface, const EdgeGroups& edges) {
  EdgeFaults open;
  std::vector<std::pair<Label, int>> balance;
  const auto count = [&balance](Label label, int step) {
    for (auto& [seen, sum] : balance)
      if (seen == label) {
        sum += step;
        return;
      }
    balance.emplace_back(label, step);
  };
  for (std::size_t e = 0; e < edges.size(); ++e) {
    balance.clear();
    for (const TriangleUse& use : edges[e]) {
      const int step = use.forward ? 1 : -1;
      count(surface.sides[use.triangle][0], step);
      count(surface.sides[use.triangle][1], -step);
    }
    if (std::any_of(balance.begin(), balance.end(), [](const auto& entry) { return entry.second != 0; }))
      open.add(surface, edges[e]);
  }
  return std::move(open).status("the surface is open at ", " edges; every label's boundary must be closed");
}

Status check_intersections(const SurfaceMesh& surface) {
  const std::vector<std::array<std::uint32_t, 2>> pairs = find_self_intersections(surface, kMaxPlaces);
  if (pairs.empty()) return std::monostate{};
  std::vector<bool> meets(surface.triangles.size(), false);
  for (const auto& [a, b] : pairs) meets[a] = meets[b] = true;
  FaultyTriangles found(surface, meets);
  return meshing_error(
      "the surface intersects itself: " + std::string(pairs.size() < kMaxPlaces ? "" : "at least ") +
          std::to_string(found.count) + " triangles do; it must be free of intersections",
      std::move(found.where));
}

Status check_overlaps(const SurfaceMesh& surface, const EdgeGroups& edges) {
  EdgeFaults overlaps;
  std::vector<Wing> wings;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges[e].size() < 3) continue;  // the sides of two that close every label agree
    wings_around(surface, edges[e], wings);
    const auto overlaps_next = [](const Wing& wing, const Wing& next) { return wing.after != next.before; };
    if (overlaps_next(wings.back(), wings.front()) ||
        std::adjacent_find(wings.begin(), wings.end(), overlaps_next) != wings.end())
      overlaps.add(surface, edges[e]);
  }
  return std::move(overlaps).status("labels overlap at ",
                                    " edges of the surface; part of it must be inside out");
}

SharpAngle find_sharpest_edge(const SurfaceMesh& surface, const EdgeGroups& edges) {
  double largest = -1;
  SharpAngle sharpest;
  for_each_dihedral(surface, edges, [&](double cosine, const TriangleUse& use, std::uint32_t) {
    if (cosine <= largest) return;
    largest = cosine;
    sharpest.place = (surface.points[use.low] + surface.points[use.high]) / 2;
  });
  sharpest.angle_deg = degrees_of(largest);
  return sharpest;
}

SharpAngle find_sharpest_corner(const SurfaceMesh& surface) {
  double largest = -1;
  SharpAngle sharpest;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const double cosine = corner_cosine(surface, t, c);
      if (cosine <= largest) continue;
      largest = cosine;
      sharpest.place = surface.points[surface.triangles[t][c]];
    }
  sharpest.angle_deg = degrees_of(largest);
  return sharpest;
}

ErrorPlace find_narrow_places(const SurfaceMesh& surface, const EdgeGroups& edges) {
  const std::vector<bool> close = nearly_coinciding(surface.points);
  std::vector<bool> narrow(surface.triangles.size(), false);
  const auto mark = [&](double corner_bound, double edge_bound) {
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c)
        if (close[surface.triangles[t][c]] || corner_cosine(surface, t, c) >= corner_bound) narrow[t] = true;
    for_each_dihedral(surface, edges, [&](double cosine, const TriangleUse& use, std::uint32_t other) {
      if (cosine >= edge_bound) narrow[use.triangle] = narrow[other] = true;
    });
  };
  mark(kNarrowCosine, kNarrowCosine);
  if (std::find(narrow.begin(), narrow.end(), true) == narrow.end()) {
    double sharpest_corner = -1, sharpest_edge = -1;
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c)
        sharpest_corner = std::max(sharpest_corner, corner_cosine(surface, t, c));
    for_each_dihedral(surface, edges, [&](double cosine, const TriangleUse&, std::uint32_t) {
      sharpest_edge = std::max(sharpest_edge, cosine);
    });
    mark(sharpest_corner, sharpest_edge);
  }
  return FaultyTriangles(surface, narrow).where;
}

}  // namespace voxtet
