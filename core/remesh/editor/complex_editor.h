// Edits of a labelled complex as transactions: checked, then done or refused.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "remesh/complex/edit.h"
#include "remesh/complex/intersection_verifier.h"
#include "remesh/editor/edit_check.h"
#include "remesh/editor/edited_complex.h"

namespace voxtet::remesh {

/// After every accepted edit the complex is free of self-intersections and within the envelope, if it was so
/// before.
class ComplexEditor : public EditedComplex {
 public:
  using EditedComplex::EditedComplex;
  ComplexEditor(const ComplexEditor&) = delete;
  ComplexEditor& operator=(const ComplexEditor&) = delete;

  /// Makes every target edge length as large as the largest.
  void set_coarsest(bool on) { floor_ = on ? *std::max_element(sizes_.begin(), sizes_.end()) : 0; }
  /// New cells for the search for near triangles.
  void set_cell(double cell_mm) { hash_.emplace(mesh_, cell_mm); }

  std::uint32_t add_vertex(const Eigen::Vector3d& p, Stratum stratum, std::uint32_t hint);
  void drop_last_vertex();
  /// `hint` replaces that of the moved vertex.
  bool attempt(const Edit& edit, Demand demand, std::uint32_t hint = kNone);
  /// The same for an edit that was checked, where nothing in the zone of the check has changed since.
  bool attempt(const Edit& edit, const EditFindings& found, std::uint32_t hint);
  /// Changes attempted so far.
  std::uint32_t attempts() const { return attempt_; }
  /// The last attempt that changed triangles of v, or ended a trial that did; 0 if none. Edits that were
  /// taken back do not count.
  std::uint32_t changed_at(std::uint32_t v) const { return v < changed_at_.size() ? changed_at_[v] : 0; }
  /// The same of edits that were taken back, too: these may leave samples of the reference elsewhere.
  std::uint32_t touched_at(std::uint32_t v) const { return v < touched_at_.size() ? touched_at_[v] : 0; }
  /// From here on it is known where the complex changes, until unwatch().
  void watch() {
    watching_ = true;
    changed_zones_.clear();
  }
  void unwatch() { watching_ = false; }
  /// Whether an edit, or its undoing, has changed anything in a zone since watch().
  bool changed_in(const FloatBox& zone) const {
    return std::any_of(changed_zones_.begin(), changed_zones_.end(),
                       [&](const FloatBox& changed) { return changed.meets(zone); });
  }
  /// From here on edits can be taken back, until keep_trial() or undo_trial().
  void begin_trial();
  void keep_trial();
  /// Takes back all edits accepted since begin_trial(); vertices that were added stay, without triangles.
  void undo_trial();
  /// Cosine of the smallest planar angle of the triangles that the trial replaced.
  double trial_cosine_before() const { return trial_cosine_; }
  /// Triangles that the trial made, each at least once.
  template <class Visit>
  void for_trial_triangles(Visit&& visit) const {
    for (const Accepted& step : trial_)
      for (const std::uint32_t t : step.back.removed)
        if (mesh_.alive(t)) visit(t);
  }
  /// Counts a refusal that was found before the edit was described in full.
  bool refuse(Refusal refusal) {
    ++refusals_[static_cast<std::size_t>(refusal)];
    return false;
  }
  std::uint64_t refusals(Refusal refusal) const { return refusals_[static_cast<std::size_t>(refusal)]; }
  std::uint64_t violations() const { return violations_; }

 private:
  void remember(const Edit& edit, const EditFindings& found);
  void commit(const Edit& edit, const EditFindings& found, bool backwards);
  void place(const Edit& edit, const EditFindings& found, std::size_t i);
  void note_zone(const EditFindings& found);
  void note_changed(const std::vector<std::uint32_t>& triangles);
  void note_touched(const std::vector<std::uint32_t>& triangles);

  EditCheck check_{*this};
  EditFindings found_;
  std::uint32_t attempt_ = 0;
  std::vector<std::uint32_t> slots_;  ///< of the facets that the last edit added
  std::vector<std::uint32_t> changed_at_, touched_at_;
  std::vector<FloatBox> changed_zones_;
  bool watching_ = false;
  std::array<std::uint64_t, kRefusalCount> refusals_{};
  std::optional<IntersectionVerifier> verifier_;
  std::uint64_t violations_ = 0;

  /// Everything needed to take an accepted edit back.
  struct Accepted {
    Edit back;
    std::vector<Deviation> deviations;  ///< of the triangles that it adds, if known
    double size = 0;                    ///< target edge length of the moved vertex
    std::uint32_t hint = kNone;
  };
  std::vector<Accepted> trial_;
  double trial_cosine_ = -1;
  std::uint32_t trial_number_ = 0;
  std::vector<std::uint32_t> placed_in_;  ///< by triangle: the trial that put it there
  bool trying_ = false;
};

}  // namespace voxtet::remesh
