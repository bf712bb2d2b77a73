#include "remesh/editor/complex_editor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/elements/surface_measures.h"
#include "geometry/elements/triangle_measures.h"
#include "geometry/intersect/triangle_intersection.h"
#include "geometry/search/closest_point.h"

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

ComplexEditor::ComplexEditor(ComplexMesh mesh, const ComplexMesh& reference,
                             const Correspondence& correspondence, const SizingField& sizing)
    : mesh_(std::move(mesh)),
      reference_(reference),
      samples_(mesh_, reference_, correspondence),
      sizing_(sizing),
      hints_(correspondence.hints) {
  sizes_.reserve(mesh_.vertex_count());
  normals_.reserve(mesh_.slot_count());
  balls_.reserve(mesh_.slot_count());
  for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) sizes_.push_back(sizing.at(mesh_.point(v)));
  for (std::uint32_t t = 0; t < mesh_.slot_count(); ++t) {
    const Corners p = mesh_.corners(mesh_.triangle(t));
    const Eigen::Vector3d cross = triangle_cross(p[0], p[1], p[2]);
    normals_.push_back(cross / std::max(cross.norm(), 1e-300));
    balls_.emplace_back(p);
  }
}

std::uint32_t ComplexEditor::add_vertex(const Eigen::Vector3d& p, Stratum stratum, std::uint32_t hint) {
  sizes_.push_back(sizing_.at(p));
  hints_.push_back(hint);
  return mesh_.add_vertex(p, stratum);
}

void ComplexEditor::drop_last_vertex() {
  sizes_.pop_back();
  hints_.pop_back();
  mesh_.drop_last_vertex();
}

bool ComplexEditor::attempt(const Edit& edit, Demand demand, std::uint32_t hint) {
  ++attempt_;
  edit_ = &edit;
  demand_ = demand;
  removed_in_.resize(mesh_.slot_count(), 0);
  for (const std::uint32_t t : edit.removed) removed_in_[t] = attempt_;
  look_at_old(edit);
  reach_mm_ = demand == Demand::kNearer ? std::max(limits.reach_mm, limits.nearer_mm) : limits.reach_mm;
  const bool moves = edit.moved != kNone;
  const Eigen::Vector3d before = moves ? mesh_.point(edit.moved) : Eigen::Vector3d::Zero();
  if (moves) mesh_.set_point(edit.moved, edit.position);
  const Refusal refusal = check(edit, before);
  if (refusal != Refusal::kNo) {
    if (moves) mesh_.set_point(edit.moved, before);
    return refuse(refusal);
  }
  if (trying_) remember(edit, before);
  if (moves) {
    sizes_[edit.moved] = sizing_.at(edit.position);
    if (hint != kNone) hints_[edit.moved] = hint;
  }
  if (limits.verify && !verifier_) verifier_.emplace(mesh_);
  commit(edit, false);
  if (trying_) {
    trial_.back().back.removed = slots_;
    placed_in_.resize(mesh_.slot_count(), 0);
    for (const std::uint32_t t : slots_) placed_in_[t] = trial_number_;
  } else {
    note_changed(slots_);
  }
  if (limits.verify) violations_ += verifier_->intersections_around(mesh_, slots_);
  return true;
}

void ComplexEditor::note_changed(const std::vector<std::uint32_t>& triangles) {
  changed_at_.resize(mesh_.vertex_count(), 0);
  for (const std::uint32_t t : triangles)
    if (mesh_.alive(t))
      for (const std::uint32_t v : mesh_.triangle(t)) changed_at_[v] = attempt_;
  note_touched(triangles);
}

void ComplexEditor::note_touched(const std::vector<std::uint32_t>& triangles) {
  touched_at_.resize(mesh_.vertex_count(), 0);
  for (const std::uint32_t t : triangles)
    if (mesh_.alive(t))
      for (const std::uint32_t v : mesh_.triangle(t)) touched_at_[v] = attempt_;
}

void ComplexEditor::look_at_old(const Edit& edit) {
  old_corners_.clear();
  old_normals_.clear();
  for (const std::uint32_t t : edit.removed) {
    old_corners_.push_back(mesh_.corners(mesh_.triangle(t)));
    old_normals_.push_back(normals_[t]);
  }
}

Refusal ComplexEditor::check(const Edit& edit, const Eigen::Vector3d& before) {
  Refusal refusal = check_shapes(edit);
  if (refusal == Refusal::kNo) refusal = samples_.try_curves(mesh_, edit, reach_mm_, before);
  if (refusal == Refusal::kNo)
    refusal = samples_.try_surface(mesh_, edit, reach_mm_,
                                   demand_ == Demand::kAllowed ? limits.turn_cosine : kTurnCosineOfSlivers,
                                   {old_corners_, old_normals_}, new_normals_);
  if (refusal != Refusal::kNo) return refusal;
  find_near(edit);
  if (limits.keeps_delaunay && demand_ != Demand::kNearer) refusal = check_delaunay(edit, before);
  if (refusal == Refusal::kNo) refusal = check_contacts(edit);
  if (refusal == Refusal::kNo) refusal = check_envelope(edit);
  return refusal;
}

Refusal ComplexEditor::check_shapes(const Edit& edit) {
  new_corners_.clear();
  new_normals_.clear();
  double old_cosine = -1, new_cosine = -1;
  for (const Corners& p : old_corners_) old_cosine = std::max(old_cosine, sharpest_cosine(p));
  const double limit =
      demand_ == Demand::kBetterAngle ? old_cosine - kCosineStep : std::max(limits.angle_cosine, old_cosine);
  for (const Facet& facet : edit.added) {
    const Corners p = mesh_.corners(facet.corners);
    new_cosine = std::max(new_cosine, sharpest_cosine(p));
    if (new_cosine > limit) return Refusal::kAngle;
    const Eigen::Vector3d cross = triangle_cross(p[0], p[1], p[2]);
    const double size = cross.norm();
    if (!(size > 0)) return Refusal::kAngle;
    new_corners_.push_back(p);
    new_normals_.push_back(cross / size);
    const std::size_t i = new_corners_.size() - 1;
    if (demand_ == Demand::kAllowed && i < old_normals_.size() &&
        new_normals_[i].dot(old_normals_[i]) < limits.turn_cosine)
      return Refusal::kNormal;
  }
  return Refusal::kNo;
}

/// The triangles that new facets may meet, or come nearer to than the gap.
void ComplexEditor::find_near(const Edit& edit) {
  new_boxes_.clear();
  for (const Corners& p : new_corners_) new_boxes_.push_back(box_of(p));
  const double longest = longest_of_facets_mm(new_corners_);
  gap_mm_ = limits.gap_share > 0 ? limits.gap_share * std::min(least_target(edit), longest) : 0;
  gap_growth_ = limits.adapted ? std::max(1.0, longest / longest_of_facets_mm(old_corners_)) : 1;
  wide_boxes_.clear();
  for (const FloatBox& box : new_boxes_) wide_boxes_.push_back(box.grown(gap_mm_));
  FloatBox all = wide_boxes_.front();
  for (const FloatBox& box : wide_boxes_) all.extend(box);
  hash_->find(all, near_);
}

Refusal ComplexEditor::check_contacts(const Edit& edit) {
  for (std::size_t i = 0; i < edit.added.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Refusal refusal = check_pair(edit.added[i], i, edit.added[j].corners, new_corners_[j],
                                         new_normals_[j], edit.added[j].pair, true);
      if (refusal != Refusal::kNo) return refusal;
    }
  for (const std::uint32_t t : near_) {
    if (is_removed(t)) continue;
    const FloatBox& box = hash_->box(t);
    const Triangle& other = mesh_.triangle(t);
    for (std::size_t i = 0; i < edit.added.size(); ++i) {
      if (!wide_boxes_[i].meets(box)) continue;
      const Refusal refusal = check_pair(edit.added[i], i, other, mesh_.corners(other), normals_[t],
                                         mesh_.pair(t), new_boxes_[i].meets(box));
      if (refusal != Refusal::kNo) return refusal;
    }
  }
  return Refusal::kNo;
}

double ComplexEditor::least_target(const Edit& edit) const {
  double target = 1e300;
  for (const Facet& facet : edit.added)
    for (const std::uint32_t v : facet.corners) target = std::min(target, size(v));
  return target;
}

Refusal ComplexEditor::check_pair(const Facet& facet, std::size_t i, const Triangle& other,
                                  const Corners& corners, const Eigen::Vector3d& normal, PairId pair,
                                  bool boxes_meet) {
  std::array<int, 3> mine{}, its{};
  int shared = 0;
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l)
      if (facet.corners[k] == other[l]) {
        mine[shared] = k;
        its[shared] = l;
        ++shared;
      }
  const Corners& p = new_corners_[i];
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
  const std::size_t mine_in = new_normals_[i].dot(corners[l] - p[k]) > 0 ? 1 : 0;
  const std::size_t its_in = normal.dot(p[k] - corners[l]) > 0 ? 1 : 0;
  const bool one_inside = mesh_.sides()[facet.pair][mine_in] == mesh_.sides()[pair][its_in];
  return one_inside ? Refusal::kNo : Refusal::kIntersection;
}

/// Whether new facets at x and y close a tetrahedron with two at the edge u w.
bool ComplexEditor::closes_tetrahedron(std::uint32_t u, std::uint32_t w, std::uint32_t x,
                                       std::uint32_t y) const {
  const auto is_added = [&](std::uint32_t end) {
    return std::any_of(edit_->added.begin(), edit_->added.end(), [&](const Facet& facet) {
      return has_corner(facet.corners, end) && has_corner(facet.corners, x) && has_corner(facet.corners, y);
    });
  };
  return is_added(u) && is_added(w);
}

bool ComplexEditor::fold_allowed(std::uint32_t u, std::uint32_t w, double cosine) {
  constexpr double kAlmostFolded = 0.9998;  // 1 degree
  if (cosine <= fold_limit(u, w)) return true;
  const double step = demand_ == Demand::kBetterFold ? kCosineStep : 0;
  return cosine < kAlmostFolded && cosine <= old_fold(on_curves(u, w)) - step;
}

/// The sharpest fold at the edges of the triangles to be removed, as they were.
double ComplexEditor::old_fold(bool junction) const {
  double sharpest = -1;
  const auto old_point = [&](std::uint32_t v) -> Eigen::Vector3d {
    for (std::size_t i = 0; i < edit_->removed.size(); ++i)
      for (int k = 0; k < 3; ++k)
        if (mesh_.triangle(edit_->removed[i])[k] == v) return old_corners_[i][k];
    return mesh_.point(v);
  };
  for (std::size_t i = 0; i < edit_->removed.size(); ++i) {
    const Triangle& t = mesh_.triangle(edit_->removed[i]);
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t u = t[k], w = t[(k + 1) % 3];
      if (junction != on_curves(u, w)) continue;
      for (const std::uint32_t other : mesh_.star(u)) {
        if (other == edit_->removed[i] || !has_corner(mesh_.triangle(other), w)) continue;
        const Eigen::Vector3d q = old_point(third_corner(mesh_.triangle(other), u, w));
        sharpest = std::max(sharpest, fold_cosine(old_corners_[i][k], old_corners_[i][(k + 1) % 3],
                                                  old_corners_[i][(k + 2) % 3], q));
      }
    }
  }
  return sharpest;
}

/// Only sheets that face each other count: of one pair of labels only those that look opposite ways, and only
/// where the way across is along both normals.
bool ComplexEditor::gap_allowed(std::size_t i, const Corners& corners, const Eigen::Vector3d& normal,
                                bool same_pair) {
  constexpr double kFacing = 0.5;
  const double turn = new_normals_[i].dot(normal);
  if (same_pair ? turn > -kFacing : std::abs(turn) < kFacing) return true;
  const Corners& p = new_corners_[i];
  const Eigen::Vector3d across = (corners[0] + corners[1] + corners[2] - p[0] - p[1] - p[2]) / 3;
  const double along = std::abs(across.dot(normal));
  if (along * along < kFacing * kFacing * across.squaredNorm()) return true;
  const double now = corner_distance2(p, corners);
  if (now >= gap_mm_ * gap_mm_) return true;
  return std::any_of(old_corners_.begin(), old_corners_.end(), [&](const Corners& old) {
    return now >= corner_distance2(old, corners) * gap_growth_ * gap_growth_;
  });
}

}  // namespace voxtet::remesh
