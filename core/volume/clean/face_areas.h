// Areas of a voxel's faces.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "types/label_volume.h"

namespace voxtet {

/// Of the face across each index axis, mm^2.
inline std::array<double, 3> face_areas(const LabelVolume& volume) {
  const Eigen::Matrix3d axes = volume.linear();
  return {axes.col(1).cross(axes.col(2)).norm(), axes.col(2).cross(axes.col(0)).norm(),
          axes.col(0).cross(axes.col(1)).norm()};
}

}  // namespace voxtet
