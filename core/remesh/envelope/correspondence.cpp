#include "remesh/envelope/correspondence.h"

#include <algorithm>
#include <map>

#include "geometry/search/closest_point.h"

namespace voxtet::remesh {
namespace {

using Pairs = std::vector<PairId>;

constexpr CurveEdge kNoEdge{kNone, kNone};

void sort_unique(Pairs& pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

Pairs pairs_at(const ComplexMesh& mesh, std::uint32_t v) {
  Pairs pairs;
  for (const std::uint32_t t : mesh.star(v)) pairs.push_back(mesh.pair(t));
  sort_unique(pairs);
  return pairs;
}

Pairs pairs_at(const ComplexMesh& mesh, const CurveEdge& edge) {
  Pairs pairs;
  for (const std::uint32_t t : mesh.star(edge[0]))
    if (has_corner(mesh.triangle(t), edge[1])) pairs.push_back(mesh.pair(t));
  sort_unique(pairs);
  return pairs;
}

std::vector<Eigen::Vector3d> points_of(const ComplexMesh& mesh) {
  std::vector<Eigen::Vector3d> points;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) points.push_back(mesh.point(v));
  return points;
}

void find_hosts(const ComplexMesh& mesh, const std::vector<Eigen::Vector3d>& points,
                const ComplexMesh& reference, double content_mm, std::vector<std::uint32_t>& hosts) {
  std::vector<std::vector<std::uint32_t>> samples(mesh.sides().size()), triangles(mesh.sides().size());
  for (std::uint32_t r = 0; r < reference.vertex_count(); ++r)
    if (!reference.star(r).empty() && reference.stratum(r) == Stratum::kSurface)
      samples[reference.pair(reference.star(r).front())].push_back(r);
  for (std::uint32_t t = 0; t < mesh.slot_count(); ++t) triangles[mesh.pair(t)].push_back(t);
  for (std::size_t pair = 0; pair < samples.size(); ++pair) {
    if (triangles[pair].empty() || samples[pair].empty()) continue;
    std::vector<Triangle> corners;
    for (const std::uint32_t t : triangles[pair]) corners.push_back(mesh.triangle(t));
    const ClosestPointTree tree(points, corners);
    std::uint32_t hint = 0;
    for (const std::uint32_t r : samples[pair]) {
      hint = tree.closest(reference.point(r), hint, content_mm).triangle;
      hosts[r] = triangles[pair][hint];
    }
  }
}

void find_curve_hosts(const ComplexMesh& mesh, const std::vector<Eigen::Vector3d>& points,
                      const ComplexMesh& reference, std::vector<CurveEdge>& hosts) {
  std::map<Pairs, std::vector<CurveEdge>> edges;
  for (std::uint32_t a = 0; a < mesh.vertex_count(); ++a) {
    if (mesh.stratum(a) == Stratum::kSurface) continue;
    std::vector<std::uint32_t> others;
    for (const std::uint32_t t : mesh.star(a))
      for (const std::uint32_t b : mesh.triangle(t))
        if (b > a && mesh.is_curve(a, b)) others.push_back(b);
    sort_unique(others);
    for (const std::uint32_t b : others) edges[pairs_at(mesh, CurveEdge{a, b})].push_back({a, b});
  }
  std::map<Pairs, std::vector<std::uint32_t>> samples;
  for (std::uint32_t r = 0; r < reference.vertex_count(); ++r)
    if (!reference.star(r).empty() && reference.stratum(r) == Stratum::kCurve)
      samples[pairs_at(reference, r)].push_back(r);
  for (const auto& [pairs, vertices] : samples) {
    const auto found = edges.find(pairs);
    if (found == edges.end()) continue;
    std::vector<Triangle> segments;
    for (const auto& [a, b] : found->second) segments.push_back({a, b, b});
    const ClosestPointTree tree(points, segments);
    std::uint32_t hint = 0;
    for (const std::uint32_t r : vertices) {
      hint = tree.closest(reference.point(r), hint).triangle;
      hosts[r] = found->second[hint];
    }
  }
}

/// Hands hints on along edges between vertices of one stratum and the same labels until no more come.
void spread_hints(const ComplexMesh& mesh, std::vector<std::uint32_t>& hints) {
  std::vector<std::uint32_t> front;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
    if (hints[v] != kNone) front.push_back(v);
  for (std::size_t i = 0; i < front.size(); ++i) {
    const std::uint32_t v = front[i];
    for (const std::uint32_t t : mesh.star(v))
      for (const std::uint32_t w : mesh.triangle(t)) {
        if (hints[w] != kNone || mesh.stratum(w) != mesh.stratum(v)) continue;
        if (mesh.stratum(v) == Stratum::kCurve && !mesh.is_curve(v, w)) continue;
        hints[w] = hints[v];
        front.push_back(w);
      }
  }
}

}  // namespace

Correspondence same_complex(const ComplexMesh& mesh) {
  const std::size_t n = mesh.vertex_count();
  Correspondence out{std::vector<std::uint32_t>(n), std::vector<std::uint32_t>(n, kNone),
                     std::vector<CurveEdge>(n, kNoEdge)};
  for (std::uint32_t v = 0; v < n; ++v) {
    out.hints[v] = v;
    if (mesh.star(v).empty()) continue;
    if (mesh.stratum(v) == Stratum::kSurface) out.hosts[v] = mesh.star(v).front();
    if (mesh.stratum(v) != Stratum::kCurve) continue;
    for (const std::uint32_t t : mesh.star(v))
      for (const std::uint32_t other : mesh.triangle(t))
        if (out.curve_hosts[v] == kNoEdge && other != v && mesh.is_curve(v, other))
          out.curve_hosts[v] = {v, other};
  }
  return out;
}

Correspondence nearest_parts(const ComplexMesh& mesh, const ComplexMesh& reference, double content_mm) {
  Correspondence out{std::vector<std::uint32_t>(mesh.vertex_count(), kNone),
                     std::vector<std::uint32_t>(reference.vertex_count(), kNone),
                     std::vector<CurveEdge>(reference.vertex_count(), kNoEdge)};
  const std::vector<Eigen::Vector3d> points = points_of(mesh);
  find_hosts(mesh, points, reference, content_mm, out.hosts);
  find_curve_hosts(mesh, points, reference, out.curve_hosts);
  for (std::uint32_t r = 0; r < reference.vertex_count(); ++r) {
    if (out.hosts[r] != kNone)
      for (const std::uint32_t v : mesh.triangle(out.hosts[r]))
        if (mesh.stratum(v) == Stratum::kSurface) out.hints[v] = r;
    if (out.curve_hosts[r] != kNoEdge)
      for (const std::uint32_t v : out.curve_hosts[r])
        if (mesh.stratum(v) == Stratum::kCurve) out.hints[v] = r;
  }
  spread_hints(mesh, out.hints);
  return out;
}

}  // namespace voxtet::remesh
