// What is known of walls, at the voxels of an image.
#pragma once

#include <vector>

#include "pipeline/stages/stage_results.h"
#include "types/label_volume.h"

namespace voxtet {

/// Calls visit(mm) for each voxel, in order.
template <class Visit>
void for_voxels(const LabelVolume& volume, Visit&& visit) {
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i) visit(volume.to_mm({1.0 * i, 1.0 * j, 1.0 * k}));
}

enum class WallValue { kThickness, kPotential };

/// At each voxel of `volume` the thickness (mm) or the potential (0 to 1) of the first wall that holds it;
/// not a number in no wall.
std::vector<float> wall_values(const Walls& walls, const LabelVolume& volume, WallValue value);

}  // namespace voxtet
