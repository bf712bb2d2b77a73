// Whether facets can be those of a Delaunay triangulation of all vertices.
#include <algorithm>

#include "remesh/editor/complex_editor.h"

namespace voxtet::remesh {

/// After find_near.
Refusal ComplexEditor::check_delaunay(const Edit& edit, const Eigen::Vector3d& before) {
  gather_near_vertices(edit);
  if (all_have_balls(edit)) return Refusal::kNo;
  for (std::size_t k = 0; k < near_vertices_.size(); ++k)
    if (near_vertices_[k] == edit.moved) near_points_[k] = before;
  for (const std::uint32_t t : edit.removed)
    if (!has_ball(mesh_.triangle(t), balls_[t])) return Refusal::kNo;
  return Refusal::kNotDelaunay;
}

/// Of the new facets and of the triangles near them, each once.
void ComplexEditor::gather_near_vertices(const Edit& edit) {
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
  for (const Facet& facet : edit.added) add(facet.corners);
  for (const std::uint32_t t : near_)
    if (!is_removed(t)) add(mesh_.triangle(t));
}

/// The new facets, and those around whose balls the moved vertex may have come into.
bool ComplexEditor::all_have_balls(const Edit& edit) const {
  for (std::size_t i = 0; i < new_corners_.size(); ++i)
    if (!has_ball(edit.added[i].corners, GabrielBalls(new_corners_[i]))) return false;
  if (edit.moved == kNone) return true;
  return std::none_of(near_.begin(), near_.end(), [&](std::uint32_t t) {
    if (is_removed(t)) return false;
    GabrielBalls balls = balls_[t];
    return balls.leave_out(edit.position) && !has_ball(mesh_.triangle(t), balls);
  });
}

/// Whether a ball of the triangle's is left without the vertices near the edit.
bool ComplexEditor::has_ball(const Triangle& corners, GabrielBalls balls) const {
  for (std::size_t k = 0; k < near_vertices_.size() && balls.any(); ++k)
    if (!has_corner(corners, near_vertices_[k])) balls.leave_out(near_points_[k]);
  return balls.any();
}

}  // namespace voxtet::remesh
