// Heat diffusion as a stage: a small example of a result that changes with time.
#pragma once

#include <memory>

#include "pipeline/stages/stage.h"

namespace voxtet {

/// Solves the recipe's physics.diffusion on the optimised tetrahedra; its value is a Trajectory. Errors:
/// kUsage for a recipe without it; those of Diffusion::start.
Result<std::unique_ptr<StageTask>> start_diffusion(const StageInputs& in, const Recipe& recipe);

}  // namespace voxtet
