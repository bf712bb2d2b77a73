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
  std::array<std::array<double, 2>, 3> weight{};
  std::array<std::size_t, 3> step{};  // to the next grid point; 0 where there is none
  std::size_t first = 0, stride = 1;
  for (std::size_t d = 0; d < 3; ++d) {
    const double x = std::clamp(index[static_cast<int>(d)], 0.0, static_cast<double>(size[d] - 1));
    const int base = std::min(static_cast<int>(x), std::max(0, size[d] - 2));
    const double t = x - base;
    weight[d] = {1 - t, t};
    first += static_cast<std::size_t>(base) * stride;
    step[d] = base + 1 < size[d] ? stride : 0;
    stride *= static_cast<std::size_t>(size[d]);
  }
  for (std::size_t z = 0; z < 2; ++z)
    for (std::size_t y = 0; y < 2; ++y)
      for (std::size_t x = 0; x < 2; ++x)
        visit(first + x * step[0] + y * step[1] + z * step[2], weight[0][x] * weight[1][y] * weight[2][z]);
}

}  // namespace voxtet
