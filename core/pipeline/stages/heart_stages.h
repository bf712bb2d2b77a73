// What a simulation of the heart needs before it, and the activation map: as stages.
#pragma once

#include "pipeline/stages/stage.h"

namespace voxtet {

/// Named surfaces and coordinates (AnatomyResult), if the recipe has physics.anatomy.
Status run_anatomy(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx);

/// FibresResult, if the recipe has physics.fibres. Errors: kUsage without physics.anatomy.
Status run_fibres(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx);

/// Tissue with the fibres that there are (TissueResult). Errors: kUsage where tissue that conducts has none,
/// though there are fibres.
Status run_tissue(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx);

/// EikonalResult of the recipe's stimuli.
Status run_eikonal(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx);

}  // namespace voxtet
