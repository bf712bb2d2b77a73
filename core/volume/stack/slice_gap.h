// Labels of the voxels between two neighbouring slices.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "volume/stack/slice_stack.h"

namespace voxtet::slices {

/// Which labels share a pixel edge in either of two slices (or the last one), and how often.
class Contacts {
 public:
  Contacts(const SliceStack& stack, int lower);
  bool touch(Label a, Label b) const { return count(a, b) > 0; }
  std::uint32_t count(Label a, Label b) const;
  /// The labels that touch both a and b, those with the longest outline to both first (the lower of equals).
  std::vector<Label> separators(Label a, Label b) const;

 private:
  std::vector<std::pair<std::uint32_t, std::uint32_t>> counts_;  // (a << 16 | b, edges), both ways, ascending
};

/// The two labels that compete for a voxel between two slices. The voxel has `first` unless the outline
/// between the two is moved by more than `margin_mm` towards `first`.
struct Candidate {
  Label first = kBackground, second = kBackground;
  float margin_mm = 0;
};

/// Voxels between slices `lower` and `lower` + 1, only where the labels of these differ. Elsewhere the label
/// that both slices have holds.
struct SliceGap {
  int lower = 0;
  std::vector<std::uint32_t> columns;  ///< pixels that differ, ascending
  std::vector<Candidate> candidates;   ///< `planes` - 1 per column, from below
  std::vector<bool> flat;  ///< per pixel of a slice: the label changes half-way, without interpolation
};

/// `near` holds the distances of the slices lower - 1 ... lower + 2, null beyond the stack's ends. `planes`
/// (odd) is the number of planes per slice.
///
/// Each label's distance is interpolated along the column by a monotone cubic (Catmull-Rom slopes, limited
/// after Fritsch and Carlson, SIAM J. Numer. Anal. 17 (1980)); the label with the largest one wins. Two rules
/// keep what would be lost with distances alone:
/// - Where no distance is positive, a structure passes that is thinner than its shift between the slices.
///   There the label wins that lies between the two slices' labels in both slices (nearer than the farther of
///   them, and touching both). If there is none, that of the two labels wins which is nearer in the slice
///   that has the other.
/// - A label that one slice does not have nearby shrinks towards that slice, together with all that encloses
///   it: no distance changes by more than the depth of what appears or vanishes there, or than the step.
/// Where everything ends at once in a region deeper than the `far_mm` of `near`, that is a cut and not a tip:
/// such pixels are `flat`.
SliceGap interpolate_gap(const SliceStack& stack, const Contacts& contacts, int lower,
                         const std::array<const SliceDistances*, 4>& near, int planes);

/// Leaves the columns in which either slice has one of these labels (65536 entries) without interpolation:
/// such labels fill the slabs of their slices.
void keep_as_slabs(SliceGap& gap, const SliceStack& stack, const std::vector<bool>& labels);

}  // namespace voxtet::slices
