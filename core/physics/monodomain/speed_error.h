// How wrong the speed of a wave is to be expected on a mesh (base/wave_speed_error.h).
#pragma once

#include <vector>

#include "physics/monodomain/monodomain.h"
#include "types/tet_mesh.h"
#include "types/tissue.h"

namespace voxtet {

/// The share of the consistent mass that a simulation has.
inline double consistent_mass_of(const MonodomainParams& params) {
  return params.integration == Integration::kExplicit ? 0 : params.consistent_mass;
}

/// The error for each tetrahedron in its worst direction, across the fibre; NaN where nothing conducts.
std::vector<float> speed_errors_percent(const TetMesh& mesh, const Tissue& tissue, double consistent_mass);

}  // namespace voxtet
