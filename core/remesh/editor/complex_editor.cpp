#include "remesh/editor/complex_editor.h"

namespace voxtet::remesh {

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
  check_.check(edit, demand, found_);
  return attempt(edit, found_, hint);
}

bool ComplexEditor::attempt(const Edit& edit, const EditFindings& found, std::uint32_t hint) {
  ++attempt_;
  if (!found.deviations.empty()) make_room_for_deviations();
  for (const auto& [t, deviation] : found.deviations) deviations_[t] = deviation;
  if (found.refusal != Refusal::kNo) return refuse(found.refusal);
  if (trying_) remember(edit, found);
  if (edit.moved != kNone) {
    sizes_[edit.moved] = sizing_.at(edit.position);
    if (hint != kNone) hints_[edit.moved] = hint;
  }
  if (limits.verify && !verifier_) verifier_.emplace(mesh_);
  commit(edit, found, false);
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

}  // namespace voxtet::remesh
