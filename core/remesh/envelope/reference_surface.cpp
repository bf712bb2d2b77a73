#include "remesh/envelope/reference_surface.h"

#include <algorithm>
#include <numeric>

#include "geometry/elements/surface_measures.h"
#include "geometry/search/closest_point.h"

namespace voxtet::remesh {
namespace {

constexpr int kLongestWalk = 256;  ///< downhill walks end by themselves; this bounds one check's time

/// Feet nearer than this need no second look, in squares of the mean spacing of vertices.
constexpr double kNearSpacing2 = 0.0625;

}  // namespace

Eigen::Vector3d closest_on_segment(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                   const Eigen::Vector3d& b) {
  const Eigen::Vector3d e = b - a;
  const double size = e.squaredNorm();
  return a + (size > 0 ? std::clamp((p - a).dot(e) / size, 0.0, 1.0) : 0.0) * e;
}

ReferenceSurface::ReferenceSurface(const ComplexMesh& mesh) {
  const std::size_t n = mesh.vertex_count();
  normals_.assign(n, Eigen::Vector3d::Zero());
  areas_.assign(n, 0);
  curve_.assign(n, {kNone, kNone});
  for (auto* flat : {&stars_, &rings_}) flat->reserve(3 * mesh.slot_count());
  first_.reserve(n + 1);
  ring_first_.reserve(n + 1);
  only_pair_.reserve(n);
  points_.reserve(n);
  strata_.reserve(n);
  triangles_.reserve(mesh.slot_count());
  pairs_.reserve(mesh.slot_count());
  first_.assign(1, 0);
  ring_first_.assign(1, 0);
  for (std::uint32_t t = 0; t < mesh.slot_count(); ++t) {
    triangles_.push_back(mesh.triangle(t));
    pairs_.push_back(mesh.pair(t));
    const Corners p = mesh.corners(mesh.triangle(t));
    const Eigen::Vector3d cross = triangle_cross(p[0], p[1], p[2]);
    for (const std::uint32_t v : mesh.triangle(t)) {
      normals_[v] += cross;
      areas_[v] += cross.norm() / 6;
    }
  }
  const double area = std::accumulate(areas_.begin(), areas_.end(), 0.0);
  near2_ = kNearSpacing2 * area / static_cast<double>(std::max<std::size_t>(n, 1));
  for (std::uint32_t v = 0; v < n; ++v) {
    points_.push_back(mesh.point(v));
    strata_.push_back(mesh.stratum(v));
    stars_.insert(stars_.end(), mesh.star(v).begin(), mesh.star(v).end());
    first_.push_back(static_cast<std::uint32_t>(stars_.size()));
    add_ring(v);
    const double size = normals_[v].norm();
    if (size > 0) normals_[v] /= size;
    if (strata_[v] != Stratum::kCurve) continue;
    for (const std::uint32_t t : mesh.star(v))
      for (const std::uint32_t other : mesh.triangle(t)) {
        if (other == v || other == curve_[v][0] || other == curve_[v][1] || !mesh.is_curve(v, other))
          continue;
        (curve_[v][0] == kNone ? curve_[v][0] : curve_[v][1]) = other;
      }
  }
}

/// Of the next vertex, each neighbour once, in the order of its triangles.
void ReferenceSurface::add_ring(std::uint32_t r) {
  PairId pair = star(r).empty() ? kNone : pairs_[star(r).front()];
  for (const std::uint32_t t : star(r))
    if (pairs_[t] != pair) pair = kNone;
  const auto begin = static_cast<std::ptrdiff_t>(rings_.size());
  if (pair != kNone)
    for (const std::uint32_t t : star(r))
      for (const std::uint32_t v : triangles_[t])
        if (v != r && std::find(rings_.begin() + begin, rings_.end(), v) == rings_.end()) rings_.push_back(v);
  only_pair_.push_back(pair);
  ring_first_.push_back(static_cast<std::uint32_t>(rings_.size()));
}

template <class VisitNeighbours>
double ReferenceSurface::walk_downhill(const Eigen::Vector3d& p, std::uint32_t& at,
                                       VisitNeighbours&& visit_neighbours) const {
  double least = (points_[at] - p).squaredNorm();
  for (int step = 0; step < kLongestWalk; ++step) {
    std::uint32_t next = at;
    visit_neighbours(at, [&](std::uint32_t v) {
      const double distance = (points_[v] - p).squaredNorm();
      if (distance < least) {
        least = distance;
        next = v;
      }
    });
    if (next == at) break;
    at = next;
  }
  return least;
}

Eigen::Vector3d ReferenceSurface::walk(const Eigen::Vector3d& p, PairId pair, std::uint32_t& hint,
                                       double enough2) const {
  const double least = walk_downhill(
      p, hint, [&](std::uint32_t from, const auto& visit) { for_neighbours(from, pair, visit); });
  Foot best{points_[hint], least, kNone};
  if (least <= enough2) return best.on;
  try_star(p, pair, hint, enough2, best);
  // Where triangles are long, the nearest vertex need not have the nearest one: go on from triangle to
  // triangle.
  const double near2 = std::max(near2_, enough2);
  for (int step = 0; step < kLongestWalk && best.distance2 > near2 && best.triangle != kNone; ++step) {
    const std::uint32_t from = best.triangle;
    for (const std::uint32_t v : triangles_[from])
      if (v != hint) try_star(p, pair, v, enough2, best);
    if (best.triangle == from) break;
    hint = triangles_[best.triangle][0];
  }
  return best.on;
}

void ReferenceSurface::try_star(const Eigen::Vector3d& p, PairId pair, std::uint32_t r, double enough2,
                                Foot& best) const {
  for (const std::uint32_t t : star(r)) {
    if (pairs_[t] != pair) continue;
    const auto& [a, b, c] = triangles_[t];
    const Eigen::Vector3d on = closest_on_triangle(p, points_[a], points_[b], points_[c]);
    const double distance2 = (on - p).squaredNorm();
    if (distance2 < best.distance2) best = {on, distance2, t};
    if (best.distance2 <= enough2) return;
  }
}

Eigen::Vector3d ReferenceSurface::walk_curve(const Eigen::Vector3d& p, std::uint32_t& hint) const {
  if (strata_[hint] != Stratum::kCurve) return p;
  double least = walk_downhill(p, hint, [&](std::uint32_t from, const auto& visit) {
    for (const std::uint32_t v : curve_[from])
      if (strata_[v] == Stratum::kCurve) visit(v);
  });
  Eigen::Vector3d best = points_[hint];
  for (const std::uint32_t v : curve_[hint]) {
    const Eigen::Vector3d on = closest_on_segment(p, points_[hint], points_[v]);
    if ((on - p).squaredNorm() < least) {
      least = (on - p).squaredNorm();
      best = on;
    }
  }
  return best;
}

}  // namespace voxtet::remesh
