// Whether facets can be those of a Delaunay triangulation of all vertices.
#include <algorithm>

#include "remesh/complex_editor.h"

namespace voxtet::remesh {

/// After find_near.
Reason ComplexEditor::check_balls(const Change& change, const Eigen::Vector3d& before) {
  gather_near_vertices(change);
  if (all_have_balls(change)) return Reason::kNo;
  for (std::size_t k = 0; k < near_vertices_.size(); ++k)
    if (near_vertices_[k] == change.moved) near_points_[k] = before;
  for (const std::uint32_t t : change.removed)
    if (!has_ball(mesh_.triangle(t), balls_[t])) return Reason::kNo;
  return Reason::kBall;
}

/// Of the new facets and of the triangles near them, each once.
void ComplexEditor::gather_near_vertices(const Change& change) {
  near_vertices_.clear();
  near_points_.clear();
  met_in_.resize(mesh_.vertex_count(), 0);
  const auto add = [this](const Triangle& t) {
    for (const std::uint32_t v : t) {
      if (met_in_[v] == attempt_) continue;
      met_in_[v] = attempt_;
      near_vertices_.push_back(v);
      near_points_.push_back(mesh_.point(v));
    }
  };
  for (const Facet& facet : change.added) add(facet.corners);
  for (const std::uint32_t t : near_)
    if (!is_removed(t)) add(mesh_.triangle(t));
}

/// The new facets, and those around whose balls the moved vertex may have come into.
bool ComplexEditor::all_have_balls(const Change& change) const {
  for (std::size_t i = 0; i < new_corners_.size(); ++i)
    if (!has_ball(change.added[i].corners, EmptyBalls(new_corners_[i]))) return false;
  if (change.moved == kNone) return true;
  return std::none_of(near_.begin(), near_.end(), [&](std::uint32_t t) {
    if (is_removed(t)) return false;
    EmptyBalls balls = balls_[t];
    return balls.leave_out(change.position) && !has_ball(mesh_.triangle(t), balls);
  });
}

/// Whether a ball of the triangle's is left without the vertices near the change.
bool ComplexEditor::has_ball(const Triangle& corners, EmptyBalls balls) const {
  for (std::size_t k = 0; k < near_vertices_.size() && balls.any(); ++k)
    if (!has_corner(corners, near_vertices_[k])) balls.leave_out(near_points_[k]);
  return balls.any();
}

}  // namespace voxtet::remesh
