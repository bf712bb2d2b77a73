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
  /// Asked of TetGen's refinement, not guaranteed; 0: not asked, since the optimiser (optimise_tets.h)
  /// reaches more with fewer points.
  double min_dihedral_deg = 0;
  double max_dihedral_deg = 145;  ///< aimed at by TetGen's own optimisation
};

/// Fills every label with tetrahedra whose edges follow `sizing`. Tets carry the label enclosed by their part
/// of the surface; background is left empty. Inner edges have a median length within some 5 % of the target.
/// TetGen keeps the surface's triangles exactly (no vertex is added on it). Delaunay refinement has to change
/// a few where they are not Delaunay: pairs that are all but flat are flipped, edges halved; ctx.note says
/// how many, and no label's volume changes by more than 0.5 %. Either way the surface's points come first,
/// unmoved; new ones and the tets follow in an order that keeps neighbours together. Should the mesher fail,
/// or ask for 20 times the points that forecast_points gives, others take its place: TetGen with a finer
/// tolerance, displaced points, no bounds on dihedral angles, bounds on sizes alone. ctx.note always says
/// which strategy succeeded and how sharp the surface is, ctx.warn where it was none of the backend's own and
/// TetGen's first, and where angles are sharp. Polls ctx.cancelled() every few milliseconds while points are
/// inserted or moved. Verified before returning: all volumes positive, boundary triangles those of the
/// surface (flipped or halved), each label's volume equal to that enclosed by its boundary to 1e-9 relative
/// and rounding. Layers get no points inside, except by TetGen, which ctx.warn tells. Errors: kMeshing with
/// the offending triangles: open or self-intersecting surface, labels that overlap, leak, internal failure,
/// flat tetrahedra that no strategy avoids; kOutOfMemory; kCancelled; kInternal for an invalid sizing field.
Result<TetMesh> fill_tets(const SurfaceMesh& surface, const SizingField& sizing, const FillParams& params,
                          RunContext& ctx, const WallLayers& layers = {});

}  // namespace voxtet
