// Adapted surface -> tetrahedra inside it.
#pragma once

#include "types/result.h"
#include "types/run_context.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"
#include "walls/wall_layers.h"

namespace voxtet {

enum class TetBackend {
  kTetgen,    ///< TetGen, keeping every triangle of the surface
  kDelaunay,  ///< own Delaunay refinement; TetGen where that fails
};

struct FillParams {
  TetBackend backend = TetBackend::kDelaunay;
  double radius_edge = 1.414;  ///< bound on circumradius over shortest edge
  /// A request to TetGen's refinement, not guaranteed. 0: none, since the optimiser (optimise_tets.h) reaches
  /// more with fewer points.
  double min_dihedral_deg = 0;
  double max_dihedral_deg = 145;  ///< what TetGen's own optimisation aims at
};

/// Fills every label with tetrahedra whose edges follow `sizing`; background is left empty. Tets carry the
/// label that their part of the surface encloses. Inner edges have a median length within some 5 % of the
/// target.
///
/// TetGen keeps the surface's triangles exactly (no vertex is added on it). Delaunay refinement changes a few
/// that are not Delaunay: edges between nearly coplanar triangles are flipped, other edges are halved.
/// ctx.note says how many, and no label's volume changes by more than 0.5 %. In both cases the surface's
/// points come first, unmoved; new points and the tets follow in an order that keeps neighbours together.
///
/// If the mesher fails, or asks for 20 times the points that forecast_points gives, fallbacks are tried:
/// TetGen with a finer tolerance, displaced points, no bounds on dihedral angles, bounds on sizes alone.
/// ctx.note always says which strategy succeeded and how sharp the surface is. ctx.warn tells if it was
/// neither the backend's own nor TetGen's first, and where angles are sharp. Polls ctx.cancelled() every few
/// milliseconds while points are inserted or moved. Layers get no points inside, except by TetGen, which
/// ctx.warn tells.
///
/// Verified before returning: all volumes are positive, boundary triangles are those of the surface (flipped
/// or halved), each label's volume equals that enclosed by its boundary to 1e-9 relative and rounding.
/// Errors: kMeshing with the offending triangles: open or self-intersecting surface, labels that overlap,
/// leak, internal failure, flat tetrahedra that no strategy avoids; kOutOfMemory; kCancelled; kInternal for
/// an invalid sizing field.
Result<TetMesh> fill_tets(const SurfaceMesh& surface, const SizingField& sizing, const FillParams& params,
                          RunContext& ctx, const WallLayers& layers = {});

}  // namespace voxtet
