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

/// Handles edges of the surface that are not in the triangulation of its points. If the other diagonal of the
/// edge's two triangles is in it and the two are nearly coplanar (the diagonals no farther apart than a tenth
/// of the edge), takes that diagonal; else adds the edge's midpoint to both. Points are only added, at the
/// end. Errors: kCancelled; kMeshing if this does not end, near sharp angles and sheets much closer than
/// their edges.
Result<Recovery> recover_surface(SurfaceMesh& surface, DelaunayCells& cells, const RunContext& ctx);

}  // namespace voxtet::tetra
