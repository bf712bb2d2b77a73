// Whether facets can be those of a Delaunay triangulation of all vertices.
#include <algorithm>

#include "remesh/editor/edit_check.h"

namespace voxtet::remesh {

/// After find_near.
Refusal EditCheck::check_delaunay() {
  gather_near_vertices();
  if (all_have_balls()) return Refusal::kNo;
  for (std::size_t k = 0; k < near_vertices_.size(); ++k)
    if (near_vertices_[k] == edit_->moved) near_points_[k] = complex_.mesh().point(edit_->moved);
  for (const std::uint32_t t : edit_->removed)
    if (!has_ball(complex_.mesh().triangle(t), complex_.balls(t))) return Refusal::kNo;
  return Refusal::kNotDelaunay;
}

/// Of the new facets and of the triangles near them, each once.
void EditCheck::gather_near_vertices() {
  near_vertices_.clear();
  near_points_.clear();
  const ComplexMesh& mesh = complex_.mesh();
  met_in_.resize(mesh.vertex_count(), 0);
  const auto add = [&](const Triangle& t) {
    for (const std::uint32_t v : t) {
      if (met_in_[v] == number_) continue;
      met_in_[v] = number_;
      near_vertices_.push_back(v);
      near_points_.push_back(v == edit_->moved ? edit_->position : mesh.point(v));
    }
  };
  for (const Facet& facet : edit_->added) add(facet.corners);
  for (const std::uint32_t t : near_)
    if (!is_removed(t)) add(mesh.triangle(t));
}

/// The new facets, and those around whose balls the moved vertex may have come into.
bool EditCheck::all_have_balls() const {
  for (std::size_t i = 0; i < found_->new_corners.size(); ++i)
    if (!has_ball(edit_->added[i].corners, GabrielBalls(found_->new_corners[i]))) return false;
  if (edit_->moved == kNone) return true;
  return std::none_of(near_.begin(), near_.end(), [&](std::uint32_t t) {
    if (is_removed(t)) return false;
    GabrielBalls balls = complex_.balls(t);
    return balls.leave_out(edit_->position) && !has_ball(complex_.mesh().triangle(t), balls);
  });
}

/// Whether a ball of the triangle's is left without the vertices near the edit.
bool EditCheck::has_ball(const Triangle& corners, GabrielBalls balls) const {
  for (std::size_t k = 0; k < near_vertices_.size() && balls.any(); ++k)
    if (!has_corner(corners, near_vertices_[k])) balls.leave_out(near_points_[k]);
  return balls.any();
}

}  // namespace voxtet::remesh
