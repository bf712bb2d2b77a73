// A wall that is a slab of bricks, and its potential.
#pragma once

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cstdint>

#include "geometry/topology/adjacency.h"
#include "types/tet_mesh.h"
#include "walls/wall_field.h"

namespace voxtet::test {

inline constexpr double kSlabThickness = 6;  ///< mm

/// A slab of `nx` x `nx` x `layers` bricks, 0 to 20 mm wide and `kSlabThickness` high, each brick cut into
/// the six tetrahedra around its diagonal. Edges never go through a layer of bricks.
inline TetMesh slab(int nx, int layers) {
  TetMesh mesh;
  const auto point = [&](int i, int j, int k) {
    return static_cast<std::uint32_t>(i + (nx + 1) * (j + (nx + 1) * k));
  };
  for (int k = 0; k <= layers; ++k)
    for (int j = 0; j <= nx; ++j)
      for (int i = 0; i <= nx; ++i)
        mesh.points.emplace_back(20.0 * i / nx, 20.0 * j / nx, kSlabThickness * k / layers);
  for (int k = 0; k < layers; ++k)
    for (int j = 0; j < nx; ++j)
      for (int i = 0; i < nx; ++i) {
        std::array<int, 3> axes{0, 1, 2};
        do {
          std::array<int, 3> at{i, j, k};
          Tet tet{point(i, j, k), 0, 0, 0};
          for (std::size_t s = 0; s < 3; ++s) {
            ++at[static_cast<std::size_t>(axes[s])];
            tet[s + 1] = point(at[0], at[1], at[2]);
          }
          const Eigen::Vector3d& p = mesh.points[tet[0]];
          if ((mesh.points[tet[1]] - p).cross(mesh.points[tet[2]] - p).dot(mesh.points[tet[3]] - p) < 0)
            std::swap(tet[2], tet[3]);
          mesh.tets.push_back(tet);
        } while (std::next_permutation(axes.begin(), axes.end()));
      }
  mesh.labels.assign(mesh.tets.size(), 1);
  add_label_faces(mesh);
  return mesh;
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
