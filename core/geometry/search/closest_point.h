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
inline Eigen::Vector3d closest_on_triangle(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
                                           const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a, ac = c - a, ap = point - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Eigen::Vector3d bp = point - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 > d3) return a + d1 / (d1 - d3) * ab;
  const Eigen::Vector3d cp = point - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0 && d2 > d6) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const double scale = 1 / (va + vb + vc);
  return a + vb * scale * ab + vc * scale * ac;
}

/// A bounding-volume tree over triangles, built once (O(n log n), median splits) and then only read.
class ClosestPointTree {
 public:
  struct Hit {
    Eigen::Vector3d point;       ///< mm
    std::uint32_t triangle = 0;  ///< index into the triangles given
    double distance_mm = 0;
  };

  /// Points and triangles are copied. At least one triangle.
  ClosestPointTree(const std::vector<Eigen::Vector3d>& points, std::span<const Triangle> triangles);

  /// The closest point; among equally close triangles that of the lowest index. A `hint` (a triangle likely
  /// to be near, such as the last hit) only makes it faster. If there are points nearer than `content_mm`,
  /// returns the first one found.
  Hit closest(const Eigen::Vector3d& point, std::uint32_t hint = 0, double content_mm = 0) const;

  /// Closest point of one of the triangles given.
  Eigen::Vector3d closest_on(std::uint32_t triangle, const Eigen::Vector3d& point) const {
    return closest_in_slot(slot_[triangle], point);
  }

  /// The triangles in an order that keeps neighbours together, and the points they use, numbered by first
  /// use.
  const std::vector<Triangle>& triangles() const { return triangles_; }
  const std::vector<Eigen::Vector3d>& points() const { return points_; }
  /// Of each of these points, its number among those given.
  const std::vector<std::uint32_t>& given_points() const { return given_points_; }

 private:
  /// A leaf (count > 0, first in triangles_) or an inner node (count 0, first in nodes_).
  struct Child {
    std::uint32_t first, count;
  };
  /// The boxes of both children together, x, y, z of the first and then of the second: one memory access
  /// decides between them.
  struct Node {
    std::array<float, 6> centre, half;  ///< half extents, slightly too large
    std::array<Child, 2> children;
  };
  struct Item {
    std::array<float, 3> low, high;
    std::uint32_t triangle;
  };
  /// `whole` receives the bounds of all items.
  Child build(std::span<Item> items, std::uint32_t first, Item& whole);
  Eigen::Vector3d closest_in_slot(std::uint32_t slot, const Eigen::Vector3d& point) const {
    const auto& [a, b, c] = triangles_[slot];
    return closest_on_triangle(point, points_[a], points_[b], points_[c]);
  }

  std::vector<Eigen::Vector3d> points_;
  std::vector<std::uint32_t> given_points_;
  std::vector<Triangle> triangles_;   ///< as the leaves hold them; a place among them is a slot
  std::vector<std::uint32_t> order_;  ///< the triangle given in each slot
  std::vector<std::uint32_t> slot_;   ///< slot of each given triangle
  std::vector<Node> nodes_;
  Child root_{};
  float margin_ = 0;  ///< mm, added to half extents for the rounding of queries
};

}  // namespace voxtet
