// The Laplace potential in a wall.
#pragma once

#include "walls/wall_grid.h"

namespace voxtet::wall {

/// A wall voxel, and what lies across its six faces, in the order -x, +x, -y, +y, -z, +z: the number of
/// another node, or one of the ends.
struct Node {
  std::array<std::uint32_t, 6> neighbour;
};
inline constexpr std::uint32_t kInnerEnd = 0xfffffffdU, kOuterEnd = 0xfffffffeU, kSideEnd = 0xffffffffU;

/// The wall as a graph, for one of its inner spaces; every other voxel outside of the wall is outer or side.
/// Nodes of even i + j + k come first, each half in the order of the grid.
struct WallGraph {
  std::vector<Node> nodes;
  std::vector<std::size_t> voxel;  ///< of each node, in the grid
  std::size_t even = 0;            ///< how many nodes of even i + j + k there are
  std::uint8_t inner_kind = kInner;
  std::array<double, 3> step_mm{};
  std::array<std::size_t, 3> stride{};
};

/// The voxels of the wall that `in_reach` marks (one entry per voxel; empty: all). Wall voxels that it does
/// not mark count as kSide.
WallGraph wall_graph(const WallGrid& grid, std::uint8_t inner_kind, int threads,
                     const std::vector<std::uint8_t>& in_reach = {});

/// The voxel across a face.
inline std::size_t across(const WallGraph& graph, std::size_t voxel, std::size_t direction) {
  return direction % 2 ? voxel + graph.stride[direction / 2] : voxel - graph.stride[direction / 2];
}

/// Distance (mm) from a node's centre to its neighbour in one of the six directions: to the next centre; or
/// to the wall's surface, which divides the step in the ratio of the distances of the two centres; or half a
/// step to a side.
double step_to(const WallGrid& grid, const WallGraph& graph, std::size_t node, std::size_t direction);

/// Laplace's equation with 0 on the inner and 1 on the outer surface and no flow through sides. Seven-point
/// stencil with the true distances to the surface (Shortley and Weller, 1938), solved by successive
/// over-relaxation in two colours until no value changes by more than 1e-3, or for 500 sweeps; it starts from
/// the solution on every other voxel. One value per node; the same bytes for any number of threads.
std::vector<float> wall_potential(const WallGrid& grid, const WallGraph& graph, int threads);

}  // namespace voxtet::wall
