// What solve_eikonal() refuses.
#pragma once

#include <optional>
#include <span>

#include "physics/eikonal/solve_eikonal.h"

namespace voxtet::eikonal {

/// The first fault that is found of those that solve_eikonal() lists, in the order: counts, kinds, shares and
/// fibres, sources.
std::optional<Error> check_input(const TetMesh& mesh, const Tissue& tissue,
                                 std::span<const EikonalSource> sources);

}  // namespace voxtet::eikonal
