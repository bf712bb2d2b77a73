// The beating heart as a stage that runs in steps.
#pragma once

#include <memory>

#include "pipeline/stages/stage.h"

namespace voxtet {

/// Solves the recipe's physics.mechanics on the wall of the optimised tetrahedra; its value is a
/// MechanicsResult with a frame (heart_fields) for each `frame_ms` from the first beat's start on, and
/// volumes and pressures at each step. Errors: kUsage for a recipe without it, without anatomy or without
/// fibres; those of beat::make_heart().
Result<std::unique_ptr<StageTask>> start_mechanics(const StageInputs& in, const Recipe& recipe);

/// Whether the stage reads that result: of the maps of activation only the one that drives it.
bool mechanics_wants(Stage input, const Recipe& recipe);

}  // namespace voxtet
