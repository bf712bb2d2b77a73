// Gives each label back, after interpolation, the volume that it has in the slices.
#pragma once

#include <vector>

#include "volume/stack/slice_gap.h"

namespace voxtet::slices {

/// Offsets of the labels' outlines (mm; index is the label, 65536 entries): a candidate's `second` takes the
/// voxel when offset[second] - offset[first] is larger than its margin. They are chosen so that the number of
/// voxels of each label among all candidates is `wanted` within about 0.1 %, as far as offsets of at most
/// `limit_mm` allow: Newton's method on the outlines' lengths, which for all labels together is a transport
/// problem with a unique solution up to a constant.
std::vector<double> balance_offsets(const std::vector<SliceGap>& gaps, const std::vector<double>& wanted,
                                    double limit_mm);

/// The label a candidate settles on.
inline Label settle(const Candidate& c, const std::vector<double>& offsets) {
  const bool lower_first = c.first < c.second;
  const Label low = lower_first ? c.first : c.second, high = lower_first ? c.second : c.first;
  const float margin = lower_first ? c.margin_mm : -c.margin_mm;  // in favour of the lower label
  return margin >= offsets[high] - offsets[low] ? low : high;
}

}  // namespace voxtet::slices
