// What the meshed labels kept of the volume's components.
#pragma once

#include <cstdint>
#include <vector>

#include "remesh/cell_complex.h"
#include "remesh/seed_interfaces.h"

namespace voxtet::remesh {

/// Components of the field (ids as in Seeds) of which no seed has a cell of the component's label beside it
/// any more. `seed_points`: each seed's id in the complex, kNone where it was not inserted.
std::vector<std::uint32_t> lost_components(const CellComplex& cells, const Seeds& seeds,
                                           const std::vector<std::uint32_t>& seed_points);

/// Number of face-connected components per label.
std::vector<std::uint32_t> count_components(const CellComplex& cells);

}  // namespace voxtet::remesh
