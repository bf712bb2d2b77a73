#include "remesh/editor/edit_check.h"

#include <algorithm>
#include <cmath>

#include "geometry/elements/surface_measures.h"
#include "geometry/elements/triangle_measures.h"
#include "geometry/intersect/triangle_intersection.h"

namespace voxtet::remesh {
namespace {

/// Improvements of an angle's cosine below this are not worth a change.
constexpr double kCosineStep = 1e-3;

double longest_of_facets_mm(const std::vector<Corners>& facets) {
  double longest = 0;
  for (const Corners& p : facets) longest = std::max(longest, longest_edge_mm(p));
  return longest;
}

}  // namespace

void look_at_removed(const EditedComplex& complex, const Edit& edit, EditFindings& found) {
  const ComplexMesh& mesh = complex.mesh();
  found.old_corners.clear();
  found.old_normals.clear();
  for (const std::uint32_t t : edit.removed) {
    found.old_corners.push_back(mesh.corners(mesh.triangle(t)));
    found.old_normals.push_back(complex.normal(t));
  }
}

void EditCheck::check(const Edit& edit, Demand demand, EditFindings& found) {
  ++number_;
  edit_ = &edit;
  found_ = &found;
  demand_ = demand;
  reach_mm_ = demand == Demand::kNearer ? std::max(limits_.reach_mm, limits_.nearer_mm) : limits_.reach_mm;
  removed_in_.resize(complex_.mesh().slot_count(), 0);
  for (const std::uint32_t t : edit.removed) removed_in_[t] = number_;
  look_at_removed(complex_, edit, found);
  found.deviations.clear();
  found.zone = box_of(found.old_corners.front());
  for (const Corners& p : found.old_corners) found.zone.extend(box_of(p));
  if (edit.moved != kNone) found.zone.extend(box_of({edit.position, edit.position, edit.position}));
  found.refusal = find_refusal();
}

Refusal EditCheck::find_refusal() {
  const ReverseEnvelope& samples = complex_.samples();
  const ComplexMesh& mesh = complex_.mesh();
  Refusal refusal = check_shapes();
  if (refusal == Refusal::kNo) refusal = samples.try_curves(mesh, *edit_, reach_mm_, found_->rehosting);
  if (refusal == Refusal::kNo)
    refusal = samples.try_surface(mesh, *edit_, reach_mm_,
                                  demand_ == Demand::kAllowed ? limits_.turn_cosine : kTurnCosineOfSlivers,
                                  {found_->old_corners, found_->old_normals},
                                  {found_->new_corners, found_->new_normals}, found_->rehosting);
  if (refusal != Refusal::kNo) return refusal;
  find_near();
  if (limits_.keeps_delaunay && demand_ != Demand::kNearer) refusal = check_delaunay();
  if (refusal == Refusal::kNo) refusal = check_contacts();
  if (refusal == Refusal::kNo) refusal = check_envelope();
  return refusal;
}

Refusal EditCheck::check_shapes() {
  found_->new_corners.clear();
  found_->new_normals.clear();
  double old_cosine = -1, new_cosine = -1;
  for (const Corners& p : found_->old_corners) old_cosine = std::max(old_cosine, sharpest_cosine(p));
  const double limit =
      demand_ == Demand::kBetterAngle ? old_cosine - kCosineStep : std::max(limits_.angle_cosine, old_cosine);
  for (const Facet& facet : edit_->added) {
    const Corners p = corners_after(complex_.mesh(), *edit_, facet);
    new_cosine = std::max(new_cosine, sharpest_cosine(p));
    if (new_cosine > limit) return Refusal::kAngle;
    const Eigen::Vector3d cross = triangle_cross(p[0], p[1], p[2]);
    const double size = cross.norm();
    if (!(size > 0)) return Refusal::kAngle;
    found_->new_corners.push_back(p);
    found_->new_normals.push_back(cross / size);
    const std::size_t i = found_->new_corners.size() - 1;
    if (demand_ == Demand::kAllowed && i < found_->old_normals.size() &&
        found_->new_normals[i].dot(found_->old_normals[i]) < limits_.turn_cosine)
      return Refusal::kNormal;
  }
  return Refusal::kNo;
}

/// The triangles that new facets may meet, or come nearer to than the gap.
void EditCheck::find_near() {
  new_boxes_.clear();
  for (const Corners& p : found_->new_corners) new_boxes_.push_back(box_of(p));
  const double longest = longest_of_facets_mm(found_->new_corners);
  gap_mm_ = limits_.gap_share > 0 ? limits_.gap_share * std::min(least_target(), longest) : 0;
  gap_growth_ = limits_.adapted ? std::max(1.0, longest / longest_of_facets_mm(found_->old_corners)) : 1;
  wide_boxes_.clear();
  for (const FloatBox& box : new_boxes_) wide_boxes_.push_back(box.grown(gap_mm_));
  FloatBox all = wide_boxes_.front();
  for (const FloatBox& box : wide_boxes_) all.extend(box);
  complex_.hash().find(all, search_, near_);
  found_->zone.extend(all);
}

Refusal EditCheck::check_contacts() {
  for (std::size_t i = 0; i < edit_->added.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Refusal refusal = check_pair(edit_->added[i], i, edit_->added[j].corners, found_->new_corners[j],
                                         found_->new_normals[j], edit_->added[j].pair, true);
      if (refusal != Refusal::kNo) return refusal;
    }
  for (const std::uint32_t t : near_) {
    if (is_removed(t)) continue;
    const FloatBox& box = complex_.hash().box(t);
    const Triangle& other = complex_.mesh().triangle(t);
    for (std::size_t i = 0; i < edit_->added.size(); ++i) {
      if (!wide_boxes_[i].meets(box)) continue;
      const Refusal refusal =
          check_pair(edit_->added[i], i, other, complex_.mesh().corners(other), complex_.normal(t),
                     complex_.mesh().pair(t), new_boxes_[i].meets(box));
      if (refusal != Refusal::kNo) return refusal;
    }
  }
  return Refusal::kNo;
}

/// The moved vertex itself needs to be looked at once for a pair.
Refusal EditCheck::check_envelope() {
  PairId met = kNone;
  double limit2 = reach_mm_ * reach_mm_;
  bool looked_back = !limits_.adapted || demand_ == Demand::kNearer;
  for (std::size_t i = 0; i < edit_->added.size(); ++i) {
    const Facet& facet = edit_->added[i];
    const std::uint32_t moved = facet.pair == met ? kNone : edit_->moved;
    met = facet.pair;
    for (;;) {
      const double distance2 = complex_.distance2_of(facet, found_->new_corners[i], moved, limit2);
      if (distance2 <= limit2) break;
      if (looked_back || distance2 == kNowhere) return Refusal::kEnvelope;
      looked_back = true;
      for (std::size_t k = 0; k < edit_->removed.size(); ++k)
        limit2 = std::max(limit2, distance2_of_removed(k));
    }
  }
  return Refusal::kNo;
}

double EditCheck::distance2_of_removed(std::size_t i) {
  const std::uint32_t t = edit_->removed[i];
  if (const Deviation* known = complex_.known_deviation(t)) return known->distance2;
  found_->deviations.emplace_back(t, complex_.find_deviation(t, found_->old_corners[i]));
  return found_->deviations.back().second.distance2;
}

double EditCheck::least_target() const {
  double target = 1e300;
  for (const Facet& facet : edit_->added)
    for (const std::uint32_t v : facet.corners) target = std::min(target, complex_.size(v));
  return target;
}

Refusal EditCheck::check_pair(const Facet& facet, std::size_t i, const Triangle& other,
                              const Corners& corners, const Eigen::Vector3d& normal, PairId pair,
                              bool boxes_meet) const {
  std::array<int, 3> mine{}, its{};
  int shared = 0;
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l)
      if (facet.corners[k] == other[l]) {
        mine[shared] = k;
        its[shared] = l;
        ++shared;
      }
  const Corners& p = found_->new_corners[i];
  if (shared == 0) {
    if (boxes_meet && triangles_meet(p, corners)) return Refusal::kIntersection;
    return gap_mm_ > 0 && !gap_allowed(i, corners, normal, facet.pair == pair) ? Refusal::kGap : Refusal::kNo;
  }
  if (shared == 1) {
    const int k = mine[0], l = its[0];
    const bool meet = triangles_meet_beyond_corner({p[k], p[(k + 1) % 3], p[(k + 2) % 3]},
                                                   {corners[l], corners[(l + 1) % 3], corners[(l + 2) % 3]});
    return meet ? Refusal::kIntersection : Refusal::kNo;
  }
  if (shared == 3) return Refusal::kIntersection;
  const int k = 3 - mine[0] - mine[1], l = 3 - its[0] - its[1];
  const double cosine = fold_cosine(p[mine[0]], p[mine[1]], p[k], corners[l]);
  const std::uint32_t u = facet.corners[mine[0]], w = facet.corners[mine[1]];
  if (!fold_allowed(u, w, cosine)) return Refusal::kDihedral;
  if (!closes_tetrahedron(u, w, facet.corners[k], other[l])) return Refusal::kNo;
  // A bump of three facets that went through the fourth, inside out, meets nothing.
  const std::size_t mine_in = found_->new_normals[i].dot(corners[l] - p[k]) > 0 ? 1 : 0;
  const std::size_t its_in = normal.dot(p[k] - corners[l]) > 0 ? 1 : 0;
  const bool one_inside =
      complex_.mesh().sides()[facet.pair][mine_in] == complex_.mesh().sides()[pair][its_in];
  return one_inside ? Refusal::kNo : Refusal::kIntersection;
}

/// Whether new facets at x and y close a tetrahedron with two at the edge u w.
bool EditCheck::closes_tetrahedron(std::uint32_t u, std::uint32_t w, std::uint32_t x, std::uint32_t y) const {
  const auto is_added = [&](std::uint32_t end) {
    return std::any_of(edit_->added.begin(), edit_->added.end(), [&](const Facet& facet) {
      return has_corner(facet.corners, end) && has_corner(facet.corners, x) && has_corner(facet.corners, y);
    });
  };
  return is_added(u) && is_added(w);
}

bool EditCheck::fold_allowed(std::uint32_t u, std::uint32_t w, double cosine) const {
  constexpr double kAlmostFolded = 0.9998;  // 1 degree
  if (cosine <= complex_.fold_limit(u, w)) return true;
  const double step = demand_ == Demand::kBetterFold ? kCosineStep : 0;
  return cosine < kAlmostFolded && cosine <= old_fold(complex_.on_curves(u, w)) - step;
}

/// The sharpest fold at the edges of the triangles to be removed, as they were.
double EditCheck::old_fold(bool junction) const {
  double sharpest = -1;
  const auto old_point = [&](std::uint32_t v) -> Eigen::Vector3d {
    for (std::size_t i = 0; i < edit_->removed.size(); ++i)
      for (int k = 0; k < 3; ++k)
        if (complex_.mesh().triangle(edit_->removed[i])[k] == v) return found_->old_corners[i][k];
    return complex_.mesh().point(v);
  };
  for (std::size_t i = 0; i < edit_->removed.size(); ++i) {
    const Triangle& t = complex_.mesh().triangle(edit_->removed[i]);
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t u = t[k], w = t[(k + 1) % 3];
      if (junction != complex_.on_curves(u, w)) continue;
      for (const std::uint32_t other : complex_.mesh().star(u)) {
        if (other == edit_->removed[i] || !has_corner(complex_.mesh().triangle(other), w)) continue;
        const Eigen::Vector3d q = old_point(third_corner(complex_.mesh().triangle(other), u, w));
        sharpest =
            std::max(sharpest, fold_cosine(found_->old_corners[i][k], found_->old_corners[i][(k + 1) % 3],
                                           found_->old_corners[i][(k + 2) % 3], q));
      }
    }
  }
  return sharpest;
}

/// Only sheets that face each other count: of one pair of labels only those that look opposite ways, and only
/// where the way across is along both normals.
bool EditCheck::gap_allowed(std::size_t i, const Corners& corners, const Eigen::Vector3d& normal,
                            bool same_pair) const {
  constexpr double kFacing = 0.5;
  const double turn = found_->new_normals[i].dot(normal);
  if (same_pair ? turn > -kFacing : std::abs(turn) < kFacing) return true;
  const Corners& p = found_->new_corners[i];
  const Eigen::Vector3d across = (corners[0] + corners[1] + corners[2] - p[0] - p[1] - p[2]) / 3;
  const double along = std::abs(across.dot(normal));
  if (along * along < kFacing * kFacing * across.squaredNorm()) return true;
  const double now = corner_distance2(p, corners);
  if (now >= gap_mm_ * gap_mm_) return true;
  return std::any_of(found_->old_corners.begin(), found_->old_corners.end(), [&](const Corners& old) {
    return now >= corner_distance2(old, corners) * gap_growth_ * gap_growth_;
  });
}

}  // namespace voxtet::remesh
