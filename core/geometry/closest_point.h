// Closest point on a set of triangles.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "types/surface_mesh.h"

namespace voxtet {

/// Closest point of one triangle. Ericson, "Real-Time Collision Detection" (2005), 5.1.5.
Eigen::Vector3d closest_on_triangle(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
                                    const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// A bounding-volume tree over triangles, built once (O(n log n), median splits) and then only read.
class ClosestPointTree {
 public:
  struct Hit {
    Eigen::Vector3d point;       ///< mm
    std::uint32_t triangle = 0;  ///< index into the triangles given
    double distance_mm = 0;
  };

  /// Triangles are copied. At least one triangle.
  ClosestPointTree(const std::vector<Eigen::Vector3d>& points, const std::vector<Triangle>& triangles);

  /// The closest point; among equally close triangles that of the lowest index. A `hint` (a triangle likely
  /// to be near, such as the last hit) only makes it faster.
  Hit closest(const Eigen::Vector3d& point, std::uint32_t hint = 0) const;

 private:
  struct Node {
    Eigen::Vector3d low, high;
    std::uint32_t first = 0;  ///< leaf: first triangle in order_; inner: index of the right child
    std::uint32_t count = 0;  ///< leaf: number of triangles; inner: 0
  };
  std::uint32_t build(std::uint32_t first, std::uint32_t count,
                      const std::vector<Eigen::AlignedBox3d>& boxes);

  std::vector<std::array<Eigen::Vector3d, 3>> corners_;  ///< in the order of order_
  std::vector<std::uint32_t> order_;                     ///< triangles as the leaves hold them
  std::vector<std::uint32_t> slot_;                      ///< the place of each triangle in order_
  std::vector<Node> nodes_;
};

}  // namespace voxtet
