// Makes a surface a part of a Delaunay triangulation of its points.
#pragma once

#include <cstddef>

#include "tetra/backends/delaunay_cells.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/surface_mesh.h"

namespace voxtet::tetra {

struct Recovery {
  std::size_t flipped = 0, split = 0;  ///< edges
};

/// Where an edge of the surface is not in the triangulation of its points: takes the other diagonal of its
/// two triangles if that is, and they are all but flat (the diagonals no farther apart than a tenth of the
/// edge); else adds the edge's midpoint to both. Points are only added, at the end. Errors: kCancelled;
/// kMeshing where this comes to no end, near sharp angles and sheets much closer than their edges.
Result<Recovery> recover_surface(SurfaceMesh& surface, DelaunayCells& cells, const RunContext& ctx);

}  // namespace voxtet::tetra
