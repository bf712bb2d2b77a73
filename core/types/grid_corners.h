// Trilinear interpolation on a regular grid.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>

namespace voxtet {

/// Calls visit(offset, weight) for the eight grid points around a continuous index, which is clamped to the
/// grid; index x runs fastest. The weights add up to one.
template <class Visit>
void for_grid_corners(const std::array<int, 3>& size, const Eigen::Vector3d& index, Visit&& visit) {
  std::array<int, 3> base{};
  std::array<double, 3> t{};
  for (int d = 0; d < 3; ++d) {
    const double x = std::clamp(index[d], 0.0, static_cast<double>(size[d] - 1));
    base[d] = std::min(static_cast<int>(x), std::max(0, size[d] - 2));
    t[d] = x - base[d];
  }
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::array<int, 3> c{};
    for (int d = 0; d < 3; ++d) {
      const bool up = (corner >> d) & 1;
      weight *= up ? t[d] : 1 - t[d];
      c[d] = std::min(base[d] + (up ? 1 : 0), size[d] - 1);
    }
    visit(static_cast<std::size_t>(c[0]) +
              static_cast<std::size_t>(size[0]) *
                  (static_cast<std::size_t>(c[1]) +
                   static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(c[2])),
          weight);
  }
}

}  // namespace voxtet
