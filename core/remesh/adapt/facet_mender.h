// Brings single facets of an adapted surface nearer to the reference, and opens sharp dihedral angles between
// them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "remesh/adapt/healing_passes.h"

namespace voxtet::remesh {

/// Each pass returns false when cancelled.
class FacetMender : public HealingPasses {
 public:
  using HealingPasses::HealingPasses;

 protected:
  /// Brings facets beyond the envelope nearer; in a narrow envelope only those that are far beyond it.
  /// Repeated around what changed: operations that failed may succeed then, and an operation may have moved
  /// another facet out of the envelope. A facet that failed twice is not tried again: among rough voxels
  /// these take most of the time, in vain.
  bool come_nearer();
  /// Opens edges that open_folds() left sharper than the limits; repeated as long as that helps.
  bool unfold();
  /// Whether everything that a trial made is within this squared distance.
  bool is_within(double distance2);
  /// The distance to which facets are to be brought, as measured at samples.
  double aim_mm() const;

 private:
  bool touched_since(std::uint32_t t, std::uint32_t attempt) const;
  bool is_worth_a_look(std::uint32_t t) const;
  void look_ahead(std::uint32_t from, double reach_mm);
  std::optional<Deviation> far_place(std::uint32_t t, double reach_mm) const;
  bool approach(std::uint32_t t, double reach_mm);
  bool bring_nearer(std::uint32_t t, const Deviation& deviation);
  bool split_and_shift(std::uint32_t v, const Eigen::Vector3d& by);
  bool unfold(std::uint32_t a, std::uint32_t b);
  bool is_flatter(double sharpest);
  /// How often it failed to bring the triangle of a slot, or an earlier one in the same slot, nearer.
  std::uint8_t& failures_of(std::uint32_t t) {
    if (t >= failures_.size()) failures_.resize(editor_.mesh().slot_count());
    return failures_[t];
  }

  std::vector<std::uint8_t> failures_, is_far_;
  std::uint32_t looked_at_ = 0;  ///< the number of attempts when come_nearer() last began a pass
};

}  // namespace voxtet::remesh
