// Tetrahedra by Delaunay refinement inside a surface.
//
// Most triangles of an adapted surface are part of the Delaunay triangulation of its points; where they are
// not, the surface is changed until they are. Then points are added at circumcentres of cells that are too
// large or too long, as in J. R. Shewchuk, "Tetrahedral mesh generation by Delaunay refinement", Symposium on
// Computational Geometry (1998), except that a point that comes too close to the surface is left out. Cells
// that stay badly shaped, flat ones above all, are left to optimise_tets.
#pragma once

#include "tetra/backends/filled_parts.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"
#include "walls/wall_layers.h"

namespace voxtet {

struct DelaunayOptions {
  double radius_edge = 1.414;
  std::size_t max_points = 0x7fffffff;  ///< gives up if more are needed
};

/// Fills everything inside the surface. Where the surface is not Delaunay, edges between nearly coplanar
/// triangles are flipped, or edges are halved by new points at the end; ctx.note says how many. No other
/// point is added on the surface, and no label's volume changes by more than 0.5 %. Edge lengths follow
/// `sizing`; layers get no points. Errors: kCancelled; kMeshing if the surface is too far from Delaunay or
/// max_points is exceeded.
Result<FilledParts> run_delaunay(SurfaceMesh& surface, const SizingField& sizing,
                                 const DelaunayOptions& options, const WallLayers& layers,
                                 const RunContext& ctx);

}  // namespace voxtet
