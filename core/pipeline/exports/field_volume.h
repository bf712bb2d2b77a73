// Fields that a mesh was made from, as images on the grid of the volume that is meshed.
#pragma once

#include <string_view>

#include "pipeline/session.h"
#include "types/scalar_volume.h"

namespace voxtet {

/// `size`: target edge length, mm. `thickness`: thickness of the walls of sizing.thickness, mm, 0 outside of
/// them. `potential`: 0 at a wall's inner surface, 1 at its outer one, -1 outside of the walls. Where walls
/// overlap, the first one counts. Errors: kUsage for another name, if the stage sizing has not run, and for a
/// recipe without walls.
Result<ScalarVolume> field_volume(const Session& session, std::string_view name);

}  // namespace voxtet
