// Lengths along the field lines of a wall's potential, to either surface.
#pragma once

#include "walls/wall_potential.h"

namespace voxtet::wall {

/// Lengths (mm) of the field line from each node to the inner and to the outer surface; +infinity where the
/// field has no direction or the line ends elsewhere. The Eulerian equations of Yezzi and Prince, "An
/// Eulerian PDE approach for computing tissue thickness", IEEE Trans. Med. Imaging 22 (2003), upwind, solved
/// in the order in which the lines run. Beyond a surface the length is minus the distance to it.
struct WallLengths {
  std::vector<float> to_inner, to_outer;
};
WallLengths wall_lengths(const WallGrid& grid, const WallGraph& graph, const std::vector<float>& potential,
                         int threads);

}  // namespace voxtet::wall
