// Heat diffusion as a stage: the small tenant that shows how a result lives in time.
#pragma once

#include <any>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "pipeline/stages/stage.h"

namespace voxtet {

/// The recipe's physics.diffusion on the optimised tetrahedra; gives a Trajectory. Errors: kUsage for a
/// recipe without it; those of Diffusion::start.
Result<std::unique_ptr<StageTask>> start_diffusion(const StageInputs& in, const Recipe& recipe);

/// {frames, end_ms} of a Trajectory.
nlohmann::json count_trajectory(const std::any& value);
/// Digest of all its frames.
std::string digest_trajectory(const std::any& value);

}  // namespace voxtet
