// The product: linear tetrahedra with a label each, and what makes them second-order.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
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

/// The edges of a tetrahedron in the order in which VTK, Abaqus, FEBio and XDMF number the nodes on them; the
/// first three are those of a triangle.
inline constexpr std::array<std::pair<std::size_t, std::size_t>, 6> kMidsidesOfTet{
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

/// Nodes on the edges of a TetMesh, one for each, which all elements at the edge share. The map from a
/// reference element to an element of nodes x_i (corners) and x_ij (on edges) is
///   x = sum_i l_i (2 l_i - 1) x_i + sum_ij 4 l_i l_j x_ij,  l: barycentric coordinates.
struct MidsideNodes {
  std::vector<std::array<std::uint32_t, 2>> edges;  ///< their ends, ascending; in ascending order
  std::vector<Eigen::Vector3d> points;              ///< mm, RAS; one per edge
  std::vector<std::array<std::uint32_t, 6>> tets;   ///< per tet the edges in the order of kMidsidesOfTet
  std::vector<std::array<std::uint32_t, 3>> faces;  ///< per face the edges 01, 12, 20
};

/// Elements of one kind, such as TetMesh::faces or TetMesh::points, under a name that files give them.
struct NamedSet {
  std::string name;                    ///< a word of letters, digits and underscores
  std::vector<std::uint32_t> members;  ///< indices, ascending
};

}  // namespace voxtet
