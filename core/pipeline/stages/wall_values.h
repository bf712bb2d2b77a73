// Thickness and potential of walls, at the voxels of an image.
#pragma once

#include <vector>

#include "pipeline/results/stage_results.h"
#include "types/label_volume.h"

namespace voxtet {

enum class WallValue { kThickness, kPotential };

/// At each voxel of `volume` the thickness (mm) or the potential (0 to 1) of the first wall that contains it;
/// NaN outside of all walls.
std::vector<float> wall_values(const Walls& walls, const LabelVolume& volume, WallValue value);

}  // namespace voxtet
