// Whether facets can be those of a Delaunay triangulation of all vertices.
#include <algorithm>

#include "remesh/complex_editor.h"
#include "remesh/empty_balls.h"

namespace voxtet::remesh {

/// After check_contacts, which found the triangles near the change.
Reason ComplexEditor::check_balls(const Change& change, const Eigen::Vector3d& before) {
  near_vertices_.clear();
  const auto add = [this](const Triangle& t) {
    near_vertices_.insert(near_vertices_.end(), t.begin(), t.end());
  };
  for (const Facet& facet : change.added) add(facet.corners);
  for (const std::uint32_t t : near_)
    if (!is_removed(t)) add(mesh_.triangle(t));
  std::sort(near_vertices_.begin(), near_vertices_.end());
  near_vertices_.erase(std::unique(near_vertices_.begin(), near_vertices_.end()), near_vertices_.end());
  near_points_.clear();
  for (const std::uint32_t v : near_vertices_) near_points_.push_back(mesh_.point(v));
  if (all_have_balls(change)) return Reason::kNo;
  for (std::size_t k = 0; k < near_vertices_.size(); ++k)
    if (near_vertices_[k] == change.moved) near_points_[k] = before;
  for (std::size_t k = 0; k < change.removed.size(); ++k)
    if (!has_ball(mesh_.triangle(change.removed[k]), old_corners_[k])) return Reason::kNo;
  return Reason::kBall;
}

/// The new facets, and those around whose balls the moved vertex may have come into.
bool ComplexEditor::all_have_balls(const Change& change) const {
  for (std::size_t i = 0; i < new_corners_.size(); ++i)
    if (!has_ball(change.added[i].corners, new_corners_[i])) return false;
  if (change.moved == kNone) return true;
  return std::none_of(near_.begin(), near_.end(), [&](std::uint32_t t) {
    if (is_removed(t)) return false;
    const Corners p = mesh_.corners(mesh_.triangle(t));
    EmptyBalls balls(p);
    return balls.leave_out(change.position) && !has_ball(mesh_.triangle(t), p);
  });
}

bool ComplexEditor::has_ball(const Triangle& corners, const Corners& p) const {
  EmptyBalls balls(p);
  for (std::size_t k = 0; k < near_vertices_.size(); ++k)
    if (!has_corner(corners, near_vertices_[k])) balls.leave_out(near_points_[k]);
  return balls.any();
}

}  // namespace voxtet::remesh
