// A segmented image: one label per voxel and where the voxels are.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace voxtet {

using Label = std::uint16_t;  ///< 0 is background
inline constexpr Label kBackground = 0;

/// What a file says about one label. `colour` is sRGB in [0, 1]; negative where the file gives none.
struct LabelInfo {
  Label label = 0;
  std::string name;
  std::array<float, 3> colour{-1.F, -1.F, -1.F};
};

/// Voxel labels on a regular grid. Index x runs fastest: offset = i + size[0]*(j + size[1]*k).
/// `index_to_mm` maps voxel indices (voxel centres at integers) to patient space, RAS, mm; any direction,
/// oblique, mirrored (determinant < 0) or sheared, but never singular.
struct LabelVolume {
  std::array<int, 3> size{0, 0, 0};
  Eigen::Matrix4d index_to_mm = Eigen::Matrix4d::Identity();
  std::vector<Label> labels;     ///< size[0]*size[1]*size[2] values
  std::vector<LabelInfo> infos;  ///< ascending by label; may be empty or partial

  std::size_t voxel_count() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }
  std::size_t offset(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(size[0]) *
               (static_cast<std::size_t>(j) +
                static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(k));
  }
  bool contains(int i, int j, int k) const {
    return i >= 0 && j >= 0 && k >= 0 && i < size[0] && j < size[1] && k < size[2];
  }
  Label at(int i, int j, int k) const { return labels[offset(i, j, k)]; }
  /// Label at (i, j, k), background outside the grid.
  Label at_or_background(int i, int j, int k) const { return contains(i, j, k) ? at(i, j, k) : kBackground; }

  Eigen::Matrix3d linear() const { return index_to_mm.topLeftCorner<3, 3>(); }
  Eigen::Vector3d origin() const { return index_to_mm.topRightCorner<3, 1>(); }
  /// Patient-space position (mm) of a continuous index.
  Eigen::Vector3d to_mm(const Eigen::Vector3d& index) const { return linear() * index + origin(); }
  /// Distance between voxel centres along each index axis, mm.
  Eigen::Vector3d spacing_mm() const { return linear().colwise().norm().transpose(); }
  double smallest_spacing_mm() const { return spacing_mm().minCoeff(); }
  /// |det|: volume of one voxel, mm^3.
  double voxel_mm3() const { return std::abs(linear().determinant()); }
};

}  // namespace voxtet
