// The surface of the ventricles' wall within a mesh: its faces, and which of them lie side by side.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "types/tet_mesh.h"

namespace voxtet::anatomy {

/// One of TetMesh::faces that has the wall on one side only.
struct WallFace {
  std::uint32_t index;     ///< in TetMesh::faces
  Triangle corners;        ///< the right-hand normal points out of the wall
  Eigen::Vector3d centre;  ///< mm
  Eigen::Vector3d normal;  ///< unit length
  double area_mm2;
};

/// Two faces with an edge in common, by their places in WallSurface::faces.
struct Contact {
  std::uint32_t a, b;
  std::array<std::uint32_t, 2> edge;  ///< points of the mesh
  double length_mm;
};

struct WallSurface {
  std::vector<WallFace> faces;    ///< in the order of TetMesh::faces
  std::vector<Contact> contacts;  ///< every pair at every edge once
};

/// `is_wall` has an entry for each of the 65536 labels.
WallSurface wall_surface(const TetMesh& mesh, const std::vector<bool>& is_wall);

}  // namespace voxtet::anatomy
