// A box cut into cubes.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace voxtet {

/// Equal cubes, from the low corner of a box on, that cover the box; numbered with x fastest.
class CubeGrid {
 public:
  /// `low` and `high` are corners of the box, mm. `edge_mm` > 0, such that there are less than 2^31 cubes.
  CubeGrid(const Eigen::Vector3d& low, const Eigen::Vector3d& high, double edge_mm)
      : low_(low), edge_(edge_mm) {
    for (std::size_t d = 0; d < 3; ++d)
      size_[d] = static_cast<int>((high - low)[static_cast<Eigen::Index>(d)] / edge_) + 1;
  }

  std::size_t count() const {
    return static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) *
           static_cast<std::size_t>(size_[2]);
  }
  /// Indices of the cube that contains a point, or of the one nearest to it.
  std::array<int, 3> steps_to(const Eigen::Vector3d& p) const {
    std::array<int, 3> steps{};
    for (std::size_t d = 0; d < 3; ++d) {
      const auto i = static_cast<Eigen::Index>(d);
      steps[d] = static_cast<int>(std::clamp((p[i] - low_[i]) / edge_, 0.0, size_[d] - 1.0));
    }
    return steps;
  }
  std::uint32_t number(const std::array<int, 3>& steps) const {
    return static_cast<std::uint32_t>(steps[0] + size_[0] * (steps[1] + size_[1] * steps[2]));
  }

 private:
  Eigen::Vector3d low_;
  double edge_;
  std::array<int, 3> size_{};
};

}  // namespace voxtet
