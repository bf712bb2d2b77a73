// Which tetrahedra a point belongs to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "types/tet_mesh.h"

namespace voxtet::fem {

/// Those of point i are tets[begin[i]] to before tets[begin[i + 1]], ascending.
struct PointTets {
  std::vector<std::size_t> begin;
  std::vector<std::uint32_t> tets;
};

PointTets tets_of_points(const TetMesh& mesh);

}  // namespace voxtet::fem
