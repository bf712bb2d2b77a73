// What is seen of a beating heart.
#pragma once

#include <vector>

#include "physics/beat/make_heart.h"
#include "types/field.h"

namespace voxtet::beat {

/// On the whole mesh: `displacement_mm` at the points, three numbers each, 0 outside of the wall; at the
/// tetrahedra, NaN outside, `fibre_strain_percent` and `thickening_percent`, how much longer they are along
/// the undeformed fibre and across the wall, and `active_stress_kpa` along the fibre.
std::vector<Field> heart_fields(const Anatomy& anatomy, const MadeHeart& made, const HeartMotion& motion);

}  // namespace voxtet::beat
