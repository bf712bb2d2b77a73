// A box of bricks, each cut into the six tetrahedra around its diagonal (Kuhn's triangulation).
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>

#include "geometry/topology/adjacency.h"
#include "types/tet_mesh.h"

namespace voxtet::test {

/// From the origin to `size_mm`, of so many bricks along x, y and z; label 1. Points run along x first.
/// `mirrored`: along which axes the bricks' diagonals run backwards.
inline TetMesh bricks(const Eigen::Vector3d& size_mm, const std::array<int, 3>& count,
                      const std::array<bool, 3>& mirrored = {}) {
  TetMesh mesh;
  const auto [nx, ny, nz] = count;
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i)
        mesh.points.emplace_back(size_mm[0] * i / nx, size_mm[1] * j / ny, size_mm[2] * k / nz);
  const auto corner = [&](const std::array<int, 3>& brick, const std::array<int, 3>& along) {
    std::array<int, 3> at{};
    for (std::size_t a = 0; a < 3; ++a) at[a] = brick[a] + (mirrored[a] ? 1 - along[a] : along[a]);
    return static_cast<std::uint32_t>(at[0] + (count[0] + 1) * (at[1] + (count[1] + 1) * at[2]));
  };
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        std::array<int, 3> axes{0, 1, 2};
        do {
          std::array<int, 3> along{};
          Tet tet{corner({i, j, k}, along), 0, 0, 0};
          for (std::size_t s = 0; s < 3; ++s) {
            ++along[static_cast<std::size_t>(axes[s])];
            tet[s + 1] = corner({i, j, k}, along);
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

/// The same bricks cut along all four diagonals, one cut over the other. With lumped mass the diffusion on it
/// is the stencil of finite differences, mirrored at the boundary. It has no faces.
inline TetMesh bricks_cut_all_ways(const Eigen::Vector3d& size_mm, const std::array<int, 3>& count) {
  TetMesh mesh = bricks(size_mm, count);
  for (const std::array<bool, 3>& mirrored :
       {std::array{true, false, false}, {false, true, false}, {false, false, true}}) {
    const TetMesh cut = bricks(size_mm, count, mirrored);
    mesh.tets.insert(mesh.tets.end(), cut.tets.begin(), cut.tets.end());
  }
  mesh.labels.assign(mesh.tets.size(), 1);
  mesh.faces.clear();
  mesh.face_sides.clear();
  return mesh;
}

}  // namespace voxtet::test
