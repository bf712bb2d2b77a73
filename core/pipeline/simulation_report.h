// What a simulation found, for the report.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "pipeline/session.h"

namespace voxtet {

/// {eikonal: {last_ms, activated}, monodomain: {end_ms, frames, activated, total_activation_ms, mean_apd_ms,
/// most_activations, beats, last_stimulus_ms, last_activation_ms, lasted_ms}}, each where there is a result.
/// `activated` is the part of the conducting points that were; `beats` tells {activated, first_ms, last_ms}
/// of the first, second, ... activation of each point, as many as there are fields of; `lasted_ms` is how
/// long after the last stimulus a point was still activated: re-entry, where it is longer than a wave needs
/// for one way through the tissue.
nlohmann::json simulation_json(const Session& session);

}  // namespace voxtet
