#include "remesh/envelope/reverse_envelope.h"

#include <algorithm>
#include <cmath>

#include "geometry/elements/surface_measures.h"
#include "geometry/search/closest_point.h"

namespace voxtet::remesh {
namespace {

/// Distance in units of the samples' spacing below which a host is as good as any.
constexpr double kNearSpacing = 0.25;

bool holds(const CurveEdge& e, std::uint32_t a, std::uint32_t b) {
  return (e[0] == a && e[1] == b) || (e[0] == b && e[1] == a);
}

double distance2_to(const Corners& c, const Eigen::Vector3d& p) {
  return (closest_on_triangle(p, c[0], c[1], c[2]) - p).squaredNorm();
}

}  // namespace

ReverseEnvelope::ReverseEnvelope(const ComplexMesh& mesh, const ReferenceSurface& reference,
                                 const Correspondence& correspondence)
    : reference_(reference),
      heads_(mesh.slot_count(), kNone),
      next_(reference.size(), kNone),
      curve_heads_(mesh.vertex_count(), kNone),
      curve_other_(reference.size(), kNone) {
  double area = 0;
  std::size_t count = 0;
  for (std::uint32_t r = 0; r < reference.size(); ++r) {
    if (const std::uint32_t host = correspondence.hosts[r]; host != kNone) {
      next_[r] = heads_[host];
      heads_[host] = r;
      area += reference.area(r);
      ++count;
    } else if (const auto& [a, b] = correspondence.curve_hosts[r]; a != kNone) {
      next_[r] = curve_heads_[a];
      curve_heads_[a] = r;
      curve_other_[r] = b;
    }
  }
  if (count > 0) near_mm_ = kNearSpacing * std::sqrt(area / static_cast<double>(count));
}

ReverseEnvelope::Found ReverseEnvelope::best_added(const Edit& edit, const std::vector<Corners>& added,
                                                   PairId pair, const Eigen::Vector3d& p) {
  Found best{1e300, kNone};
  for (std::uint32_t i = 0; i < edit.added.size(); ++i) {
    if (edit.added[i].pair != pair) continue;
    const double distance2 = distance2_to(added[i], p);
    if (distance2 < best.distance2) best = {distance2, i};
  }
  return best;
}

ReverseEnvelope::Found ReverseEnvelope::best_beside(const ComplexMesh& mesh, const Edit& edit, PairId pair,
                                                    const Eigen::Vector3d& p, Found best) const {
  const Triangle around = edit.added[best.host].corners;
  for (const std::uint32_t v : around)
    for (const std::uint32_t t : mesh.star(v)) {
      if (mesh.pair(t) != pair ||
          std::find(edit.removed.begin(), edit.removed.end(), t) != edit.removed.end())
        continue;
      const auto& [a, b, c] = mesh.triangle(t);
      const double distance2 =
          (closest_on_triangle(p, mesh.point(a), mesh.point(b), mesh.point(c)) - p).squaredNorm();
      if (distance2 < best.distance2) best = {distance2, Rehosting::kBeside + t};
    }
  return best;
}

Refusal ReverseEnvelope::try_surface(const ComplexMesh& mesh, const Edit& edit, double reach_mm,
                                     double least_cosine, const FacetShapes& removed,
                                     const FacetShapes& added, Rehosting& rehosting) const {
  rehosting.surface.clear();
  const double reach2 = reach_mm * reach_mm;
  for (std::size_t i = 0; i < edit.removed.size(); ++i) {
    const std::uint32_t t = edit.removed[i];
    if (t >= heads_.size()) continue;
    const PairId pair = mesh.pair(t);
    for (std::uint32_t s = heads_[t]; s != kNone; s = next_[s]) {
      const Eigen::Vector3d& p = reference_.point(s);
      Found found{1e300, kNone};
      if (i < edit.added.size() && edit.added[i].pair == pair) {
        const auto& [a, b, c] = added.corners[i];
        const Eigen::Vector3d off = closest_on_triangle(p, a, b, c) - p;
        const double along = off.dot(added.normals[i]);
        const double distance2 = off.squaredNorm();
        // The foot is inside the facet: no other is much closer.
        if (distance2 <= reach2 && along * along >= 0.999 * distance2)
          found = {distance2, static_cast<std::uint32_t>(i)};
      }
      if (found.host == kNone) {
        found = best_added(edit, added.corners, pair, p);
        if (found.host == kNone) return Refusal::kReverse;
        if (found.distance2 > near_mm_ * near_mm_) found = best_beside(mesh, edit, pair, p, found);
      }
      if (found.distance2 > reach2 && found.distance2 > distance2_to(removed.corners[i], p))
        return Refusal::kReverse;
      if (found.host < Rehosting::kBeside) {
        const double cosine = added.normals[found.host].dot(reference_.normal(s));
        if (cosine < least_cosine && cosine < removed.normals[i].dot(reference_.normal(s)))
          return Refusal::kNormal;
      }
      rehosting.surface.push_back({s, found.host});
    }
  }
  return Refusal::kNo;
}

Refusal ReverseEnvelope::try_curves(const ComplexMesh& mesh, const Edit& edit, double reach_mm,
                                    Rehosting& rehosting) const {
  rehosting.curves.clear();
  const auto new_point = [&](std::uint32_t v) { return v == edit.moved ? edit.position : mesh.point(v); };
  const double reach2 = reach_mm * reach_mm;
  for (const CurveEdge& old : edit.curves_removed)
    for (const std::uint32_t end : old) {
      if (end >= curve_heads_.size()) continue;
      for (std::uint32_t s = curve_heads_[end]; s != kNone; s = next_[s]) {
        if (!holds(old, end, curve_other_[s])) continue;
        const Eigen::Vector3d& p = reference_.point(s);
        Found found{1e300, kNone};
        for (std::uint32_t i = 0; i < edit.curves_added.size(); ++i) {
          const auto& [a, b] = edit.curves_added[i];
          const double distance2 = (closest_on_segment(p, new_point(a), new_point(b)) - p).squaredNorm();
          if (distance2 < found.distance2) found = {distance2, i};
        }
        if (found.distance2 > reach2 &&
            found.distance2 >
                (closest_on_segment(p, mesh.point(old[0]), mesh.point(old[1])) - p).squaredNorm())
          return Refusal::kCurve;
        rehosting.curves.push_back({s, found.host});
      }
    }
  return Refusal::kNo;
}

void ReverseEnvelope::commit(const Edit& edit, const Rehosting& rehosting,
                             const std::vector<std::uint32_t>& slots) {
  for (const std::uint32_t t : edit.removed)
    if (t < heads_.size()) heads_[t] = kNone;
  for (const Rehosting::Move& move : rehosting.surface) {
    const std::uint32_t host =
        move.host < Rehosting::kBeside ? slots[move.host] : move.host - Rehosting::kBeside;
    if (host >= heads_.size()) heads_.resize(host + 1, kNone);
    next_[move.sample] = heads_[host];
    heads_[host] = move.sample;
  }
  for (const CurveEdge& old : edit.curves_removed)
    for (const std::uint32_t end : old) {
      if (end >= curve_heads_.size()) continue;
      std::uint32_t* link = &curve_heads_[end];
      while (*link != kNone)
        if (holds(old, end, curve_other_[*link]))
          *link = next_[*link];
        else
          link = &next_[*link];
    }
  for (const Rehosting::Move& move : rehosting.curves) {
    const auto& [a, b] = edit.curves_added[move.host];
    if (a >= curve_heads_.size()) curve_heads_.resize(a + 1, kNone);
    next_[move.sample] = curve_heads_[a];
    curve_heads_[a] = move.sample;
    curve_other_[move.sample] = b;
  }
}

}  // namespace voxtet::remesh
