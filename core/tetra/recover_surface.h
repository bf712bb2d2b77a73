// Makes a surface a part of a Delaunay triangulation of its points.
#pragma once

#include <cstddef>
#include <optional>

#include "tetra/delaunay_cells.h"
#include "types/surface_mesh.h"

namespace voxtet::tetra {

struct Recovery {
  std::size_t flipped = 0, split = 0;  ///< edges
};

/// Where an edge of the surface is not in the triangulation: takes the other diagonal of its two triangles if
/// that is, and they are flat (a tenth of the edge between the diagonals); else adds the edge's midpoint to
/// both. Points are only added, at the end. Nothing is returned where this comes to no end: near sharp angles
/// and sheets much closer than their edges.
std::optional<Recovery> recover_surface(SurfaceMesh& surface, DelaunayCells& cells);

}  // namespace voxtet::tetra
