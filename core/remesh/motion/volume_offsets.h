// How far to offset sheets so that labels get their volumes back.
#pragma once

#include <vector>

#include "types/surface_mesh.h"

namespace voxtet::remesh {

/// By pair of labels, an offset in mm along the normals that to first order gives each label the volume it
/// lacks: lambda_behind - lambda_front, which of all such offsets has the least area-weighted square. At most
/// `most_mm`. `lacking_mm3` by label; entry 0 (background) means nothing.
std::vector<double> volume_offsets(const std::vector<Sides>& pairs, const std::vector<double>& areas_mm2,
                                   const std::vector<double>& lacking_mm3, double most_mm);

}  // namespace voxtet::remesh
