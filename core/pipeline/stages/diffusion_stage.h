// Heat diffusion as a stage: the small tenant that shows how a result lives in time.
#pragma once

#include <memory>

#include "pipeline/stages/stage.h"

namespace voxtet {

/// The recipe's physics.diffusion on the optimised tetrahedra; gives a Trajectory. Errors: kUsage for a
/// recipe without it; those of Diffusion::start.
Result<std::unique_ptr<StageTask>> start_diffusion(const StageInputs& in, const Recipe& recipe);

}  // namespace voxtet
