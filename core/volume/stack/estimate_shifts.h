// By how much the slices of a stack are shifted against each other, as by breath-holds.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "types/run_context.h"
#include "volume/stack/slice_stack.h"

namespace voxtet::slices {

/// Moves (mm, in the plane) that put the slices back.
struct ShiftEstimate {
  std::vector<Eigen::Vector2d> moves_mm;  ///< one a slice; zero where nothing is known
  double spread_mm = 0;                   ///< standard deviation of the shifts, along each of both axes
};

/// Slices whose shifts have a spread below half a pixel are as they were meant.
inline constexpr double kLeastSpread = 0.5;

/// Each slice is to lie midway between its neighbours (fit_slice), all slices together: a body may lean, as
/// no stack shows a motion of the whole or a shear that is linear along it, and both are left out of the
/// moves. Bodies also bend, by about the square of what the outlines' fit leaves per slice distance. The
/// moves are the most probable ones for this bending and normal shifts, whose spread is found by expectation
/// and maximisation: a smoothing spline whose weight the data choose (Wahba, J. R. Stat. Soc. B 40 (1978)).
/// All are zero for a spread below half the smallest pixel. No move is longer than `largest_mm`. Needs five
/// slices with labels, and else moves nothing. Stops early, with moves that are of no use, when cancelled.
ShiftEstimate estimate_shifts(const SliceStack& stack, double largest_mm, const RunContext& ctx);

}  // namespace voxtet::slices
