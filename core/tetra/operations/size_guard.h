// Keeps edge lengths near their target while shapes improve.
#pragma once

#include <algorithm>

#include "tetra/mesh/tet_quality.h"
#include "types/sizing_field.h"

namespace voxtet::tetra {

/// Which new edges are allowed: those of 0.4 to 1.9 times the target at their midpoint, or nearer to that
/// range than the edges that were there.
class SizeGuard {
 public:
  /// The field has to outlive the guard.
  explicit SizeGuard(const SizingField& sizing) : sizing_(sizing) {}

  /// The length of an edge over the target at its middle.
  double ratio(const Point& a, const Point& b) const { return (b - a).norm() / sizing_.at((a + b) / 2); }
  /// How far an edge is out of the range, as a factor; at most 1 inside the range.
  double misfit(const Point& a, const Point& b) const {
    constexpr double kShortest = 0.4, kLongest = 1.9;
    const double length = ratio(a, b);
    return std::max(kShortest / length, length / kLongest);
  }
  bool allows(const Point& a, const Point& b, double misfit_before = 1) const {
    return misfit(a, b) <= std::max(1.0, misfit_before);
  }

 private:
  const SizingField& sizing_;
};

}  // namespace voxtet::tetra
