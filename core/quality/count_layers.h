// How many elements lie between the two surfaces of a wall.
#pragma once

#include <span>
#include <vector>

#include "types/quality_report.h"
#include "types/tet_mesh.h"
#include "types/wall_field.h"

namespace voxtet {

/// A wall with the number of layers that was wished.
struct LayeredWall {
  const WallField& field;
  std::uint32_t layers = 1;
};

/// Counts layers over the outer surface of each wall, in two ways that share nothing but the surface.
/// by_edges: the fewest edges from a vertex of the outer surface to the inner one, weighted by its share of
/// the area. by_lines: from each outer face down the gradient of the potential, tetrahedron by tetrahedron,
/// how many of the sheets floor(layers * potential at the centroid) are met; lines that end elsewhere than on
/// the inner surface are not counted.
///
/// The wall's tetrahedra are those of the labels of which most of the volume lies in the wall. Its surface is
/// inner or outer where the potential falls or rises across it (within 60 degrees), else it is a side, such
/// as the rim of the base; outer vertices that two edges join to a side are left out.
std::vector<LayerCount> count_layers(const TetMesh& mesh, std::span<const LayeredWall> walls);

}  // namespace voxtet
