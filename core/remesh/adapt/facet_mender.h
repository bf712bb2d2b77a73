// Single facets of an adapted surface brought nearer to the reference, and folds between them opened.
#pragma once

#include <cstdint>
#include <vector>

#include "remesh/adapt/healing_passes.h"

namespace voxtet::remesh {

/// Each pass is false when cancelled.
class FacetMender : public HealingPasses {
 public:
  using HealingPasses::HealingPasses;

 protected:
  /// Facets beyond the envelope; in a narrow one only those that are far. Again around what changed: what
  /// could not be done may be possible then, and an operation may have taken another facet as far as its own
  /// was. Where it failed twice it is not tried again: among rough voxels it takes most of the time, in vain.
  bool come_nearer();
  /// Edges that open_folds() left folded more sharply than the limits, again as long as that helps.
  bool unfold();
  /// Whether all that a trial made is.
  bool is_within(double distance2);
  /// How near facets are to come, as far as samples show.
  double aim_mm() const;

 private:
  bool approach(std::uint32_t t, double reach_mm);
  bool bring_nearer(std::uint32_t t, const ComplexEditor::Deviation& deviation);
  bool split_and_shift(std::uint32_t v, const Eigen::Vector3d& by);
  bool unfold(std::uint32_t a, std::uint32_t b);
  bool is_flatter(double sharpest);
  /// How often nothing brought a triangle, or what stood in its slot before, nearer.
  std::uint8_t& failures_of(std::uint32_t t) {
    if (t >= failures_.size()) failures_.resize(editor_.mesh().slot_count());
    return failures_[t];
  }

  std::vector<std::uint8_t> failures_;
  std::uint32_t looked_at_ = 0;  ///< after which attempt come_nearer() has last begun a pass
};

}  // namespace voxtet::remesh
