// The result of a mesher, unchecked.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "types/tet_mesh.h"

namespace voxtet {

/// Tets are positive. `regions` numbers the parts that a surface's triangles bound; parts of different labels
/// have different numbers.
struct FilledParts {
  std::vector<Eigen::Vector3d> points;  ///< the surface's, then new ones
  std::vector<Tet> tets;
  std::vector<std::uint32_t> regions;  ///< one per tet
};

}  // namespace voxtet
