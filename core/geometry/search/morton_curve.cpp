#include "geometry/search/morton_curve.h"

#include <array>
#include <limits>
#include <numeric>

namespace voxtet {
namespace {

constexpr unsigned kMortonBits = 10;  ///< an axis; the code has 30

/// Two zeros after each of the lowest ten bits.
std::uint32_t spread_bits(std::uint32_t x) {
  x = (x | (x << 16)) & 0x030000FFU;
  x = (x | (x << 8)) & 0x0300F00FU;
  x = (x | (x << 4)) & 0x030C30C3U;
  return (x | (x << 2)) & 0x09249249U;
}

}  // namespace

MortonCurve::MortonCurve(std::span<const Eigen::Vector3d> points)
    : low_(Eigen::Vector3d::Constant(std::numeric_limits<double>::max())) {
  Eigen::Vector3d high = -low_;
  for (const Eigen::Vector3d& p : points) {
    low_ = low_.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double extent = (high - low_).maxCoeff();
  scale_ = extent > 0 ? ((1U << kMortonBits) - 1) / extent : 0;
}

std::uint32_t MortonCurve::place(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d cell = scale_ * (point - low_);
  return spread_bits(static_cast<std::uint32_t>(cell.x())) |
         spread_bits(static_cast<std::uint32_t>(cell.y())) << 1 |
         spread_bits(static_cast<std::uint32_t>(cell.z())) << 2;
}

std::vector<std::uint32_t> order_of_places(const std::vector<std::uint32_t>& places) {
  std::vector<std::uint32_t> order(places.size()), next(places.size());
  std::iota(order.begin(), order.end(), 0U);
  for (unsigned shift = 0; shift < 3 * kMortonBits; shift += kMortonBits) {
    std::array<std::uint32_t, (1U << kMortonBits) + 1> first{};
    const auto digit = [&](std::uint32_t i) { return (places[i] >> shift) & ((1U << kMortonBits) - 1); };
    for (const std::uint32_t i : order) ++first[digit(i) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    for (const std::uint32_t i : order) next[first[digit(i)]++] = i;
    order.swap(next);
  }
  return order;
}

}  // namespace voxtet
