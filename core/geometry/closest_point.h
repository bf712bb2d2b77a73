// Closest point on a set of triangles.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
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

  /// The corners of a triangle given.
  const std::array<Eigen::Vector3d, 3>& corners(std::uint32_t triangle) const {
    return corners_[slot_[triangle]];
  }
  /// Every triangle once, those near each other close together.
  const std::vector<std::uint32_t>& order() const { return order_; }

 private:
  /// A leaf (count > 0, first in order_) or an inner node (count 0, first in nodes_).
  struct Child {
    std::uint32_t first = 0, count = 0;
  };
  /// Bounds of both children together: one look at the memory decides between them.
  struct Node {
    std::array<std::array<float, 6>, 2> boxes;  ///< low x, y, z, high x, y, z; never too small
    std::array<Child, 2> children;
  };
  struct Item {
    std::array<float, 3> centre;
    std::uint32_t triangle;
  };
  Child build(std::span<Item> items, std::uint32_t first, const std::vector<std::array<float, 6>>& boxes,
              std::array<float, 6>& bounds);

  std::vector<std::array<Eigen::Vector3d, 3>> corners_;  ///< in the order of order_
  std::vector<std::uint32_t> order_;                     ///< triangles as the leaves hold them
  std::vector<std::uint32_t> slot_;                      ///< the place of each triangle in order_
  std::vector<Node> nodes_;
  Child root_;
};

}  // namespace voxtet
