// An image of numbers: one value per voxel and where the voxels are.
#pragma once

#include <vector>

#include "types/grid.h"

namespace voxtet {

struct ScalarVolume : Grid {
  std::vector<float> values;  ///< voxel_count() values
};

}  // namespace voxtet
