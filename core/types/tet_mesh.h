// The product: linear tetrahedra with a label each.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "types/surface_mesh.h"

namespace voxtet {

using Tet = std::array<std::uint32_t, 4>;

/// Points in mm, RAS. Every tetrahedron is positive: (p1-p0) . ((p2-p0) x (p3-p0)) > 0 (VTK's order).
/// `faces` are the triangles between different labels or between a label and background, with the convention
/// of SurfaceMesh (sides[0] > sides[1], normal from sides[0] to sides[1]). Every point is used by some tet.
struct TetMesh {
  std::vector<Eigen::Vector3d> points;
  std::vector<Tet> tets;
  std::vector<Label> labels;  ///< one per tet, never background
  std::vector<Triangle> faces;
  std::vector<Sides> face_sides;  ///< one per face
};

/// Elements of one kind, such as TetMesh::faces or TetMesh::points, under a name that files give them.
struct NamedSet {
  std::string name;                    ///< a word of letters, digits and underscores
  std::vector<std::uint32_t> members;  ///< indices, ascending
};

}  // namespace voxtet
