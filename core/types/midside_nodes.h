// What makes the elements of a TetMesh second-order: a node on each edge.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace voxtet {

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

}  // namespace voxtet
