// The points of tissue that a stimulus excites.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "types/result.h"
#include "types/stimulus.h"

namespace voxtet {

/// Indices of the points in the stimulus' region, ascending. `tissue` says of each point whether it conducts;
/// empty: all do. Errors: kUsage, naming `field` (physics.stimuli[0]), for numbers out of range, and where no
/// point of tissue lies in the region; it says how far the nearest is.
Result<std::vector<std::uint32_t>> stimulated_points(const std::vector<Eigen::Vector3d>& points,
                                                     const std::vector<bool>& tissue,
                                                     const Stimulus& stimulus, const std::string& field);

}  // namespace voxtet
