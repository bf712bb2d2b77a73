// Stimuli as the sources of an eikonal wave.
#pragma once

#include <vector>

#include "physics/eikonal/solve_eikonal.h"
#include "types/stimulus.h"

namespace voxtet {

/// Every point of conducting tissue in the region of a stimulus, at the time at which that is first given.
/// Errors: kUsage where there is no stimulus; those of stimulated_points().
Result<std::vector<EikonalSource>> eikonal_sources(const TetMesh& mesh, const Tissue& tissue,
                                                   const std::vector<Stimulus>& stimuli);

}  // namespace voxtet
