// Puts slices back that are shifted against each other in their plane, as by breath-holds.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "types/label_volume.h"
#include "types/result.h"
#include "types/run_context.h"

namespace voxtet {

/// A move that the user gives: of one slice, counted from 0 along the thick axis, along the slice's two index
/// axes in their order.
struct SliceShift {
  std::uint32_t slice = 0;
  double first_mm = 0, second_mm = 0;
  bool operator==(const SliceShift&) const = default;
};

struct AlignParams {
  bool align_slices = false;             ///< moves are estimated
  double largest_shift_mm = 10;          ///< no estimated move is longer
  std::vector<SliceShift> slice_shifts;  ///< these slices are moved so, estimated or not
};

/// What was done to one slice.
struct AlignedSlice {
  SliceShift move;  ///< as it was made
  bool given = false;
  /// With the neighbours, the mean of both (slices::overlap): of labels that are the same.
  double overlap_before = 1, overlap_after = 1;
};

struct SliceAlignment {
  int axis = 2;                      ///< across the slices
  double spread_mm = 0;              ///< standard deviation of the shifts that were found, along each axis
  std::vector<AlignedSlice> slices;  ///< empty: nothing was moved
};

struct AlignedVolume {
  std::shared_ptr<const LabelVolume> volume;  ///< the same object if nothing was moved
  SliceAlignment alignment;
};

/// Moves the slices of a stack (one axis with thick slices, interpolate_slices.h) by `slice_shifts`, and all
/// others, if `align_slices`, by what estimate_shifts finds. The grid grows where labels would leave it.
/// Notes what was moved; warns, if nothing was asked for, of shifts that are found, and of what is asked for
/// in vain. Errors: kUsage for moves of a slice that there is not, or twice, or where there are no thick
/// slices; kCancelled.
Result<AlignedVolume> align_slices(const std::shared_ptr<const LabelVolume>& volume,
                                   const AlignParams& params, double slice_ratio, const RunContext& ctx);

}  // namespace voxtet
