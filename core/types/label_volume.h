// A segmented image: one label per voxel and where the voxels are.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "types/grid.h"

namespace voxtet {

using Label = std::uint16_t;  ///< 0 is background
inline constexpr Label kBackground = 0;

/// What a file says about one label. `colour` is sRGB in [0, 1]; negative where the file gives none.
struct LabelInfo {
  Label label = 0;
  std::string name;
  std::array<float, 3> colour{-1.F, -1.F, -1.F};
};

/// The labels of an image's voxels.
struct LabelVolume : Grid {
  std::vector<Label> labels;     ///< voxel_count() values
  std::vector<LabelInfo> infos;  ///< ascending by label; may be empty or partial

  Label at(int i, int j, int k) const { return labels[offset(i, j, k)]; }
  /// Label at (i, j, k), background outside the grid.
  Label at_or_background(int i, int j, int k) const { return contains(i, j, k) ? at(i, j, k) : kBackground; }
};

}  // namespace voxtet
