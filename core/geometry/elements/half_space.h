// Proof in floating point that vectors lie strictly on one side of some plane through the origin.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace voxtet {

/// Up to N vectors, by coordinate.
template <std::size_t N>
struct Vectors {
  std::array<double, N> x, y, z;
  template <class P>
  void set(std::size_t i, const P& to, const P& from) {
    x[i] = to[0] - from[0];
    y[i] = to[1] - from[1];
    z[i] = to[2] - from[2];
  }
};

/// True only if some n has n.v > 0, and n.v >= distance * |n|, for every v. Each v is the exact difference of
/// two points, given rounded once. False says nothing. If true, the origin is outside the convex hull of the
/// vectors. So two sets of points have disjoint hulls if the differences of their points pass, and a point is
/// outside a hull if the differences to it pass. n walks towards the point of the hull nearest to the origin
/// (Gilbert, "An iterative procedure for computing the minimum of a quadratic form on a convex set", 1966).
/// Each product is compared with its rounding error: three roundings of sums, three of products, one of the
/// difference, of at most |n|max |v|max each.
template <std::size_t N>
bool in_open_half_space(const Vectors<N>& v, double distance = 0) {
  constexpr int kSteps = 8;
  constexpr double kRoundings = 16 * 1.1102230246251565e-16;
  constexpr double kUnderflow = 1e-290;
  double nx = 0, ny = 0, nz = 0, largest = 0;
  for (std::size_t i = 0; i < N; ++i) {
    nx += v.x[i];
    ny += v.y[i];
    nz += v.z[i];
    largest = std::max(largest, std::max(std::fabs(v.x[i]), std::max(std::fabs(v.y[i]), std::fabs(v.z[i]))));
  }
  nx /= N;
  ny /= N;
  nz /= N;
  for (int step = 0; step < kSteps; ++step) {
    double least = nx * v.x[0] + ny * v.y[0] + nz * v.z[0];
    std::size_t at = 0;
    for (std::size_t i = 1; i < N; ++i) {
      const double product = nx * v.x[i] + ny * v.y[i] + nz * v.z[i];
      if (product < least) {
        least = product;
        at = i;
      }
    }
    const double n_max = std::max(std::fabs(nx), std::max(std::fabs(ny), std::fabs(nz)));
    const double rounding = kRoundings * n_max * largest + kUnderflow;
    if (least > rounding && least - rounding >= distance * std::sqrt(nx * nx + ny * ny + nz * nz))
      return true;
    const double dx = nx - v.x[at], dy = ny - v.y[at], dz = nz - v.z[at];
    const double along = nx * dx + ny * dy + nz * dz, length2 = dx * dx + dy * dy + dz * dz;
    if (!(along > 0) || !(along < length2)) return false;
    const double t = along / length2;
    nx -= t * dx;
    ny -= t * dy;
    nz -= t * dz;
  }
  return false;
}

}  // namespace voxtet
