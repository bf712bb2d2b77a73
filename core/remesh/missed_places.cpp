#include "remesh/missed_places.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "geometry/closest_point.h"
#include "geometry/surface_measures.h"

namespace voxtet::remesh {
namespace {

constexpr std::size_t kMostSamples = 100'000;
constexpr std::size_t kThoroughStride = 2;
constexpr double kTurnedShare = 0.1;  ///< of the limit: nearer than this, a turned triangle does no harm

std::uint32_t pair_of(const Sides& sides) {
  return (static_cast<std::uint32_t>(sides[0]) << 16) | sides[1];
}

bool beside_any(const Sides& sides, const std::vector<Label>& labels) {
  return std::binary_search(labels.begin(), labels.end(), sides[0]) ||
         std::binary_search(labels.begin(), labels.end(), sides[1]);
}

/// Ids of triangles (every `stride`-th, and every other one beside the listed labels) grouped by their two
/// labels.
std::vector<std::uint32_t> by_pair(const SurfaceMesh& surface, std::size_t stride,
                                   const std::vector<Label>& labels) {
  std::vector<std::uint32_t> ids;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (t % stride == 0 || (t % kThoroughStride == 0 && beside_any(surface.sides[t], labels)))
      ids.push_back(static_cast<std::uint32_t>(t));
  std::stable_sort(ids.begin(), ids.end(), [&](std::uint32_t a, std::uint32_t b) {
    return pair_of(surface.sides[a]) < pair_of(surface.sides[b]);
  });
  return ids;
}

Eigen::Vector3d cross_of(const SurfaceMesh& surface, const Triangle& t) {
  return triangle_cross(surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]);
}

bool is_turned(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double cosine) {
  return a.dot(b) < cosine * std::sqrt(a.squaredNorm() * b.squaredNorm());
}

Eigen::Vector3d centroid(const SurfaceMesh& surface, std::uint32_t t) {
  const auto [a, b, c] = surface.triangles[t];
  return (surface.points[a] + surface.points[b] + surface.points[c]) / 3;
}

/// The point near a triangle's centroid, along its normal, where the field changes between its two labels.
std::optional<Eigen::Vector3d> onto_field(const SurfaceMesh& surface, std::uint32_t t,
                                          const LabelField& field, double reach_mm) {
  const Eigen::Vector3d middle = centroid(surface, t);
  const Eigen::Vector3d normal = cross_of(surface, surface.triangles[t]).normalized();
  const auto [behind, front] = surface.sides[t];
  for (const double reach : {0.2 * reach_mm, 0.5 * reach_mm, reach_mm}) {
    const Eigen::Vector3d from = middle - reach * normal, to = middle + reach * normal;
    const Label at_from = field.at(from), at_to = field.at(to);
    if (field.layers().parent(at_from) != behind || field.layers().parent(at_to) != front) continue;
    Label other = kBackground;
    return field.crossing(from, at_from, to, at_to, other);
  }
  return std::nullopt;
}

}  // namespace

std::vector<Eigen::Vector3d> missed_places(const SurfaceMesh& reference, const SurfaceMesh& surface,
                                           const LabelField& field, const MissedCriteria& criteria) {
  const double limit = criteria.limit_mm, separation2 = criteria.separation_mm * criteria.separation_mm;
  const std::size_t stride = std::max<std::size_t>(1, reference.triangles.size() / kMostSamples);
  const std::vector<std::uint32_t> samples = by_pair(reference, stride, criteria.thorough);
  const std::vector<std::uint32_t> ids = by_pair(surface, 1, {});
  std::vector<Eigen::Vector3d> missed;
  std::vector<Triangle> triangles;
  auto from = ids.begin();
  for (auto s = samples.begin(); s != samples.end();) {
    const std::uint32_t pair = pair_of(reference.sides[*s]);
    const bool thorough = beside_any(reference.sides[*s], criteria.thorough);
    const auto last =
        std::find_if(s, samples.end(), [&](std::uint32_t t) { return pair_of(reference.sides[t]) != pair; });
    while (from != ids.end() && pair_of(surface.sides[*from]) < pair) ++from;
    triangles.clear();
    for (; from != ids.end() && pair_of(surface.sides[*from]) == pair; ++from)
      triangles.push_back(surface.triangles[*from]);
    const std::size_t known = missed.size();
    const auto add = [&](std::uint32_t t) {
      const std::optional<Eigen::Vector3d> p = onto_field(reference, t, field, limit);
      const auto close = [&](const Eigen::Vector3d& q) { return (q - *p).squaredNorm() < separation2; };
      if (p && std::none_of(missed.begin() + static_cast<std::ptrdiff_t>(known), missed.end(), close))
        missed.push_back(*p);
    };
    if (triangles.empty()) {
      for (; s != last; ++s) add(*s);
      continue;
    }
    const ClosestPointTree tree(surface.points, triangles);
    std::uint32_t hint = 0;
    const double content = thorough ? kTurnedShare * limit : limit;
    for (; s != last; ++s) {
      const ClosestPointTree::Hit hit = tree.closest(centroid(reference, *s), hint, content);
      hint = hit.triangle;
      const bool lid = thorough && hit.distance_mm > kTurnedShare * limit &&
                       is_turned(cross_of(reference, reference.triangles[*s]),
                                 cross_of(surface, triangles[hit.triangle]), criteria.turned_cosine);
      if (lid || hit.distance_mm > limit) add(*s);
    }
  }
  return missed;
}

std::vector<Eigen::Vector3d> missed_junctions(const SurfaceMesh& reference, const std::vector<Edge>& edges,
                                              const SurfaceMesh& surface, double limit_mm) {
  std::vector<Eigen::Vector3d> missed;
  if (edges.empty()) return missed;
  const std::vector<Edge> found = junction_edges(surface);
  const auto middle = [](const SurfaceMesh& mesh, const Edge& edge) -> Eigen::Vector3d {
    return 0.5 * (mesh.points[edge[0]] + mesh.points[edge[1]]);
  };
  if (found.empty()) {
    for (const Edge& edge : edges) missed.push_back(middle(reference, edge));
    return missed;
  }
  const auto curves = [](const SurfaceMesh& mesh, const std::vector<Edge>& of) {
    std::vector<Triangle> segments;
    for (const auto& [a, b] : of) segments.push_back({a, b, b});
    return ClosestPointTree(mesh.points, segments);
  };
  const ClosestPointTree wanted = curves(reference, edges), have = curves(surface, found);
  std::uint32_t hint = 0;
  for (const Edge& edge : edges) {
    const ClosestPointTree::Hit hit = have.closest(middle(reference, edge), hint, limit_mm);
    hint = hit.triangle;
    if (hit.distance_mm > limit_mm) missed.push_back(middle(reference, edge));
  }
  for (const Edge& edge : found) {
    const ClosestPointTree::Hit hit = wanted.closest(middle(surface, edge), hint, limit_mm);
    hint = hit.triangle;
    if (hit.distance_mm > limit_mm) missed.push_back(hit.point);
  }
  return missed;
}

}  // namespace voxtet::remesh
