// Moves points back towards their start wherever one of their triangles is not acceptable.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "types/surface_mesh.h"

namespace voxtet {

using Flags = std::vector<std::uint8_t>;  ///< 0 or 1 by index

/// Keeps `triangles`, `start` and `points` by reference. Every point stays on the segment from its start to
/// where it was at construction. `threads`: see parallel_for.
class Retreat {
 public:
  Retreat(const std::vector<Triangle>& triangles, const std::vector<Eigen::Vector3d>& start,
          std::vector<Eigen::Vector3d>& points, int threads);

  /// Flags of the triangles with a corner away from its start.
  Flags displaced() const;

  /// Moves the corners of the flagged triangles halfway back, at the fifth time all the way. After every
  /// third call their neighbourhood grows by a ring of triangles. On return the triangles with a corner that
  /// moved are flagged. Repeated calls end with nothing flagged: at the latest with all points at their
  /// start.
  void step(Flags& flagged);

  /// Number of points that were moved back, and of steps.
  std::size_t moved_back() const { return moved_back_; }
  int steps() const { return steps_; }
  bool went_back(std::size_t point) const { return halvings_[point] > 0; }

 private:
  Flags corners_of(const Flags& flagged) const;
  Flags triangles_at(const Flags& moved) const;

  const std::vector<Triangle>& triangles_;
  const std::vector<Eigen::Vector3d>& start_;
  std::vector<Eigen::Vector3d>& points_;
  int threads_;
  Flags halvings_;
  std::size_t moved_back_ = 0;
  int steps_ = 0;
};

}  // namespace voxtet
