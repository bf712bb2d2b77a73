// How far a slice is off the middle of the slices before and behind it, by the outlines of its labels.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "volume/stack/slice_stack.h"

namespace voxtet::slices {

/// Signed distances (mm, positive inside) from the outlines of a stack's largest labels and of all labels
/// together, each with the holes that it encloses: by outline and slice, on a box of width x height pixels
/// that holds all labels and a margin. Empty where a slice has too little of a label.
struct SliceOutlines {
  int width = 0, height = 0;
  std::array<double, 2> pixel_mm{};
  std::vector<std::vector<std::vector<float>>> mm;
};

/// `first` and `count`: the slices. The margin is `margin_mm`. Time is linear in the pixels and the labels.
SliceOutlines slice_outlines(const SliceStack& stack, int first, int count, double margin_mm);

/// The move that brings a slice's outlines midway between those of its neighbours.
struct SliceFit {
  Eigen::Vector2d move_mm = Eigen::Vector2d::Zero();
  /// By direction, of trace 2: outlines say nothing of moves along them. Zero where no label is in all three.
  Eigen::Matrix2d weight = Eigen::Matrix2d::Zero();
  double misfit_mm = 0;  ///< median that is left after the move
};

/// Slice `slice` against its two neighbours, all moved by `shifts_mm`. Midway is where the mean of the
/// neighbours' signed distances is zero, but for a constant of each label, by which it is wider or narrower
/// than they are. What is left is minimised by iterated least squares with Cauchy's weights: parts that
/// appear or end count little.
SliceFit fit_slice(const SliceOutlines& outlines, int slice, const std::vector<Eigen::Vector2d>& shifts_mm);

}  // namespace voxtet::slices
