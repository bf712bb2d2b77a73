// The monodomain model as a stage that runs in steps.
#pragma once

#include <memory>

#include "pipeline/stages/stage.h"

namespace voxtet {

/// Solves the recipe's physics.monodomain on the optimised tetrahedra; its value is a Trajectory with a frame
/// of the voltage for each `frame_ms`, and a value of each electrode for each millisecond. Errors: kUsage for
/// a recipe without it; those of Monodomain::start.
Result<std::unique_ptr<StageTask>> start_monodomain(const StageInputs& in, const Recipe& recipe);

}  // namespace voxtet
