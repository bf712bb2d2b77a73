// The points that touch tissue that conducts.
#pragma once

#include <cstdint>
#include <vector>

#include "types/tet_mesh.h"
#include "types/tissue.h"

namespace voxtet {

/// For each point of the mesh whether a tetrahedron at it conducts. `tissue` has a kind for each tetrahedron.
inline std::vector<bool> conducting_points(const TetMesh& mesh, const Tissue& tissue) {
  std::vector<bool> conducts(mesh.points.size(), false);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    if (tissue.kind[t] != Tissue::kNone)
      for (const std::uint32_t point : mesh.tets[t]) conducts[point] = true;
  return conducts;
}

}  // namespace voxtet
