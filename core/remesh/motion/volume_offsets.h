// Normal offsets of sheets that give labels their volumes back.
#pragma once

#include <vector>

#include "types/surface_mesh.h"

namespace voxtet::remesh {

/// For each pair of labels, an offset in mm along the normals that to first order gives each label the volume
/// it lacks: lambda_behind - lambda_front, with the least area-weighted sum of squares of all such offsets.
/// At most `most_mm`. `lacking_mm3` is by label; entry 0 (background) has no meaning.
std::vector<double> volume_offsets(const std::vector<Sides>& pairs, const std::vector<double>& areas_mm2,
                                   const std::vector<double>& lacking_mm3, double most_mm);

}  // namespace voxtet::remesh
