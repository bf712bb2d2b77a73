// Morton's curve: an order in which points that are near each other in space mostly follow each other.
#pragma once

#include <Eigen/Core>
#include <cstddef>
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

  /// The place of a point's cell along the curve. The point must lie in the box of the points given.
  std::uint32_t place(const Eigen::Vector3d& point) const;

  /// The numbers below `count` in the order in which the curve visits point_at(number).
  template <class PointAt>
  std::vector<std::uint32_t> order(std::size_t count, const PointAt& point_at) const;

 private:
  Eigen::Vector3d low_;
  double scale_;
};

/// The indices of `places` by ascending place, equal places by index.
std::vector<std::uint32_t> order_of_places(const std::vector<std::uint32_t>& places);

template <class PointAt>
std::vector<std::uint32_t> MortonCurve::order(std::size_t count, const PointAt& point_at) const {
  std::vector<std::uint32_t> places;
  places.reserve(count);
  for (std::size_t i = 0; i < count; ++i) places.push_back(place(point_at(i)));
  return order_of_places(places);
}

}  // namespace voxtet
