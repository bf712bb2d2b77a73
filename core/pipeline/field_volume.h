// The fields behind a mesh as images, on the grid of the volume that is meshed.
#pragma once

#include <string_view>

#include "pipeline/session.h"
#include "types/scalar_volume.h"

namespace voxtet {

/// `size`: target edge length, mm. `thickness`: of the walls of sizing.thickness, mm, 0 outside of them.
/// `potential`: 0 at a wall's inner surface, 1 at its outer one, -1 outside of the walls. Where walls
/// overlap, the first holds. Errors: kUsage for another name, for a stage sizing that has not run, and for a
/// recipe without walls.
Result<ScalarVolume> field_volume(const Session& session, std::string_view name);

}  // namespace voxtet
