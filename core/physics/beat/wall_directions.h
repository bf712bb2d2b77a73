// Which wall a tetrahedron is of, and the way through it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "physics/ventricles/ventricular_potentials.h"
#include "types/heart_surfaces.h"
#include "types/tet_mesh.h"

namespace voxtet::beat {

struct WallDirections {
  std::vector<bool> right;              ///< by tetrahedron: whether it is of the right ventricle's free wall
  std::vector<Eigen::Vector3d> across;  ///< outwards, of length 1; 0 where it is of no wall
};

/// The way through the wall is against the gradient of the own ventricle's potential.
WallDirections wall_directions(const TetMesh& mesh, const HeartSurfaces& surfaces,
                               const VentricularPotentials& potentials);

}  // namespace voxtet::beat
