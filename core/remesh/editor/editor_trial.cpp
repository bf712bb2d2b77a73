// Accepted edits, and the way back.
#include <algorithm>

#include "geometry/elements/surface_measures.h"
#include "geometry/elements/triangle_measures.h"
#include "remesh/editor/complex_editor.h"

namespace voxtet::remesh {

void ComplexEditor::begin_trial() {
  trying_ = true;
  trial_.clear();
  ++trial_number_;
  trial_cosine_ = -1;
}

void ComplexEditor::keep_trial() {
  trying_ = false;
  for (const Accepted& step : trial_) note_changed(step.back.removed);
}

void ComplexEditor::remember(const Edit& edit, const EditFindings& found) {
  Accepted& step = trial_.emplace_back();
  for (std::size_t i = 0; i < edit.removed.size(); ++i) {
    const std::uint32_t t = edit.removed[i];
    step.back.added.push_back({mesh_.triangle(t), mesh_.pair(t)});
    const bool own = t < placed_in_.size() && placed_in_[t] == trial_number_;
    step.deviations.push_back(t < deviations_.size() ? deviations_[t] : kUnknown);
    if (!own) trial_cosine_ = std::max(trial_cosine_, sharpest_cosine(found.old_corners[i]));
  }
  step.back.curves_removed = edit.curves_added;
  step.back.curves_added = edit.curves_removed;
  if (edit.moved == kNone) return;
  step.back.moved = edit.moved;
  step.back.position = mesh_.point(edit.moved);
  step.size = sizes_[edit.moved];
  step.hint = hints_[edit.moved];
}

void ComplexEditor::undo_trial() {
  trying_ = false;
  for (auto step = trial_.rbegin(); step != trial_.rend(); ++step) {
    const Edit& back = step->back;
    look_at_removed(*this, back, found_);
    if (back.moved != kNone) {
      sizes_[back.moved] = step->size;
      hints_[back.moved] = step->hint;
    }
    found_.new_corners.clear();
    found_.new_normals.clear();
    for (const Facet& facet : back.added) {
      const Corners p = corners_after(mesh_, back, facet);
      found_.new_corners.push_back(p);
      found_.new_normals.push_back(triangle_cross(p[0], p[1], p[2]).normalized());
    }
    constexpr double kAnywhere = 1e100, kAnyhow = -2;
    samples_.try_curves(mesh_, back, kAnywhere, found_.rehosting);
    samples_.try_surface(mesh_, back, kAnywhere, kAnyhow, {found_.old_corners, found_.old_normals},
                         {found_.new_corners, found_.new_normals}, found_.rehosting);
    commit(back, found_, true);
    note_touched(slots_);
    for (std::size_t i = 0; i < slots_.size(); ++i)
      if (slots_[i] < deviations_.size()) deviations_[slots_[i]] = step->deviations[i];
  }
}

/// Backwards, so that facets return to the slots where they were.
void ComplexEditor::commit(const Edit& edit, const EditFindings& found, bool backwards) {
  if (edit.moved != kNone) mesh_.set_point(edit.moved, edit.position);
  const std::size_t count = std::max(edit.added.size(), edit.removed.size());
  slots_.assign(edit.added.size(), kNone);
  for (std::size_t i = 0; i < count; ++i) place(edit, found, backwards ? count - 1 - i : i);
  samples_.commit(edit, found.rehosting, slots_);
  if (watching_) note_zone(found);
}

/// All facets that are gone or new, and those that samples went to or left.
void ComplexEditor::note_zone(const EditFindings& found) {
  FloatBox zone = box_of(found.old_corners.front());
  for (const Corners& p : found.old_corners) zone.extend(box_of(p));
  for (const Corners& p : found.new_corners) zone.extend(box_of(p));
  for (const Rehosting::Move& move : found.rehosting.surface)
    if (move.host >= Rehosting::kBeside) zone.extend(hash_->box(move.host - Rehosting::kBeside));
  changed_zones_.push_back(zone);
}

void ComplexEditor::place(const Edit& edit, const EditFindings& found, std::size_t i) {
  if (i >= edit.added.size()) {
    hash_->erase(edit.removed[i]);
    mesh_.remove(edit.removed[i]);
    return;
  }
  if (i < edit.removed.size()) {
    slots_[i] = edit.removed[i];
    mesh_.replace(slots_[i], edit.added[i]);
    hash_->move(slots_[i], found.new_corners[i]);
  } else {
    slots_[i] = mesh_.add(edit.added[i]);
    hash_->insert(slots_[i], found.new_corners[i]);
  }
  const GabrielBalls balls(found.new_corners[i]);
  if (slots_[i] == normals_.size()) {
    normals_.push_back(found.new_normals[i]);
    balls_.push_back(balls);
  } else {
    normals_[slots_[i]] = found.new_normals[i];
    balls_[slots_[i]] = balls;
  }
  if (slots_[i] < deviations_.size()) deviations_[slots_[i]] = kUnknown;
}

}  // namespace voxtet::remesh
