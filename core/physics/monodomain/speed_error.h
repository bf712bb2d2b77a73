// How wrong the speed of a wave is to be expected on a mesh (base/wave_speed_error.h).
#pragma once

#include <vector>

#include "physics/monodomain/monodomain.h"
#include "types/tet_mesh.h"
#include "types/tissue.h"

namespace voxtet {

/// The error for each tetrahedron in its worst direction, across the fibre; NaN where nothing conducts.
/// `corrected`: what is left of it when MonodomainParams::correct_speed is set.
std::vector<float> speed_errors_percent(const TetMesh& mesh, const Tissue& tissue, double consistent_mass,
                                        bool corrected = false);

}  // namespace voxtet
