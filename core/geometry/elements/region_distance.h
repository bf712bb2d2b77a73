// Distances to regions.
#pragma once

#include <Eigen/Core>

#include "types/region.h"

namespace voxtet {

/// A region with its rotation resolved once.
class RegionDistance {
 public:
  explicit RegionDistance(const Region& region);
  /// Distance (mm) from a point to the region, 0 inside.
  double at(const Eigen::Vector3d& point_mm) const;
  /// The corners of the axis-aligned box that holds all points nearer than `margin_mm`.
  Eigen::Vector3d low(double margin_mm) const;
  Eigen::Vector3d high(double margin_mm) const;

 private:
  Region region_;
  Eigen::Matrix3d to_box_;  ///< RAS directions to the box's own axes
  Eigen::Vector3d middle_, half_;
};

}  // namespace voxtet
