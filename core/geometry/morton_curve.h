// Morton's curve: an order in which neighbours in space are mostly neighbours.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace voxtet {

/// The curve of G. M. Morton, "A computer oriented geodetic data base" (IBM, 1966), through 1024^3 cells
/// around points.
class MortonCurve {
 public:
  /// Finite points, at least one.
  explicit MortonCurve(std::span<const Eigen::Vector3d> points);

  /// How far along the curve the cell of a point between those is.
  std::uint32_t place(const Eigen::Vector3d& point) const;

 private:
  Eigen::Vector3d low_;
  double scale_;
};

/// The numbers of the places in ascending order, equal places by number.
std::vector<std::uint32_t> order_of_places(const std::vector<std::uint32_t>& places);

}  // namespace voxtet
