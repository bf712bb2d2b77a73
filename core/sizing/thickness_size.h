// The thickness of a wall -> edge lengths in it.
#pragma once

#include <vector>

#include "sizing/build_sizing_field.h"

namespace voxtet {

/// Lowers `sizes` (mm, one per grid point) to what `rule` asks for in the wall and two voxels around it.
void lower_by_thickness(const WallField& wall, const ThicknessSize& rule, const SizingField& grid,
                        std::vector<float>& sizes);

}  // namespace voxtet
