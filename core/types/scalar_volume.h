// An image of numbers: one value per voxel and where the voxels are.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace voxtet {

/// Values on a regular grid, index x fastest; `index_to_mm` as in LabelVolume (types/label_volume.h).
struct ScalarVolume {
  std::array<int, 3> size{0, 0, 0};
  Eigen::Matrix4d index_to_mm = Eigen::Matrix4d::Identity();
  std::vector<float> values;  ///< size[0]*size[1]*size[2]

  Eigen::Matrix3d linear() const { return index_to_mm.topLeftCorner<3, 3>(); }
  /// Distance between voxel centres along each index axis, mm.
  Eigen::Vector3d spacing_mm() const { return linear().colwise().norm().transpose(); }
};

}  // namespace voxtet
