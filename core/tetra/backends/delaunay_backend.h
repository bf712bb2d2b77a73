// Tetrahedra by Delaunay refinement inside a surface.
//
// The surface of an adapted body is all but a part of the Delaunay triangulation of its points; where it is
// not, it is made one. Points are then added at circumcentres of cells that are too large or too long, as in
// J. R. Shewchuk, "Tetrahedral mesh generation by Delaunay refinement", Symposium on Computational Geometry
// (1998), except that a point that comes too close to the surface is left out. What remains badly shaped,
// flat cells above all, is for optimise_tets.
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
  std::size_t max_points = 0x7fffffff;  ///< given up where more are needed
};

/// Fills everything inside the surface. Where that is not Delaunay, flat pairs of its triangles are flipped,
/// or edges are halved by points that come after the others; ctx.note says how many. No other point is added
/// on it, and no label's volume changes by more than 0.5 %. Edge lengths follow `sizing`; layers get no
/// points. Errors: kCancelled; kMeshing where the surface is too far from Delaunay, or for max_points.
Result<FilledParts> run_delaunay(SurfaceMesh& surface, const SizingField& sizing,
                                 const DelaunayOptions& options, const WallLayers& layers,
                                 const RunContext& ctx);

}  // namespace voxtet
