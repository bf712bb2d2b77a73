// A wall that is a slab of bricks, and its potential.
#pragma once

#include "support/bricks.h"
#include "types/tet_mesh.h"
#include "walls/wall_field.h"

namespace voxtet::test {

inline constexpr double kSlabThickness = 6;  ///< mm

/// A slab of `nx` x `nx` x `layers` bricks, 0 to 20 mm wide and `kSlabThickness` high. Edges never go through
/// a layer of bricks.
inline TetMesh slab(int nx, int layers) {
  return bricks({20, 20, kSlabThickness}, {nx, nx, layers});
}

/// The wall of the slab: the potential rises with z.
inline WallField slab_wall() {
  WallField field;
  field.wall = {1};
  field.size = {25, 25, 11};
  field.index_to_mm.topRightCorner<3, 1>() << -2, -2, -2;
  field.invert();
  for (int k = 0; k < 11; ++k)
    for (int n = 0; n < 25 * 25; ++n) {
      field.thickness_mm.push_back(kSlabThickness);
      field.potential.push_back(static_cast<float>((k - 2) / kSlabThickness));
      field.in_wall.push_back(k >= 2 && k <= 8);
    }
  return field;
}

}  // namespace voxtet::test
