// What lies between two neighbouring slices.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "volume/slice_stack.h"

namespace voxtet::slices {

/// Which labels share a pixel edge in either of two slices, and how often.
class Contacts {
 public:
  Contacts(const SliceStack& stack, int lower);
  bool touch(Label a, Label b) const { return count(a, b) > 0; }
  std::uint32_t count(Label a, Label b) const;
  /// The labels that touch both of two, those with the longest outline to both first (the lower of equals).
  std::vector<Label> separators(Label a, Label b) const;

 private:
  std::vector<std::pair<std::uint32_t, std::uint32_t>> counts_;  // (a << 16 | b, edges), both ways, ascending
};

/// The label of a voxel between two slices and the runner-up: `first` holds it as long as the outline between
/// them is not moved by more than `margin_mm` towards it.
struct Candidate {
  Label first = kBackground, second = kBackground;
  float margin_mm = 0;
};

/// Between slices `lower` and `lower` + 1, only where their labels differ: elsewhere both slices' label
/// holds.
struct SliceGap {
  int lower = 0;
  std::vector<std::uint32_t> columns;  ///< pixels that differ, ascending
  std::vector<Candidate> candidates;   ///< `planes` - 1 for each column, from below
  std::vector<bool> flat;              ///< per pixel of a slice: the label changes in the middle, undisputed
};

/// `near` holds the distances of the slices lower - 1 ... lower + 2, null beyond the stack's ends; `planes`
/// (odd) is the number of planes a slice.
///
/// Each label's distance is interpolated along the column by a monotone cubic (Catmull-Rom slopes, limited
/// after Fritsch and Carlson, SIAM J. Numer. Anal. 17 (1980)); the largest wins. Two rules keep what
/// distances alone lose:
/// - Where none is positive, something thinner than its shift between the slices passes through: the label
///   that lies between the two slices' labels in both of them (nearer than the farther one, and touching
///   both), or else that of the two which is nearer in the slice where it is not itself.
/// - A label that one slice does not have nearby shrinks towards it, together with all that encloses it: no
///   distance changes by more than the depth of what appears or vanishes there, or than the step.
/// Regions deeper than `far` of `near` in which everything ends at once are cuts, not tips: flat.
SliceGap interpolate_gap(const SliceStack& stack, const Contacts& contacts, int lower,
                         const std::array<const SliceDistances*, 4>& near, int planes);

}  // namespace voxtet::slices
