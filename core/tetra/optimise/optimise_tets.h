// Tetrahedra -> better-shaped tetrahedra of the same domain.
// B. M. Klingner and J. R. Shewchuk, "Aggressive tetrahedral mesh improvement", 16th International Meshing
// Roundtable (2007).
#pragma once

#include "geometry/cut/cut_plane.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"
#include "walls/wall_layers.h"

namespace voxtet {

struct OptimiseParams {
  double min_dihedral_deg = 35;  ///< tets with a smaller dihedral angle are worked on
  double insertion_deg = 33;     ///< at tets that stay below this, vertices are inserted and slide
  int rounds = 4;                ///< 0 leaves the mesh as it is
  /// How far from the label surface a sliding vertex, or the middle of a flipped edge, may be, as a part of
  /// the target edge length, unless it already is farther; 0: the boundary stays as it is. Twice that around
  /// the few tets that nothing else brings to `insertion_deg`.
  double slide = 0.1;
};

/// Works on the worst tets first: removes edges and faces, moves vertices, inserts vertices, and combines
/// several of these where none helps alone. Each change raises the lowest quality (tetra/mesh/tet_quality.h)
/// around it. At the end vertices move to bring edges nearer to their targets, as far as no tet falls below
/// `min_dihedral_deg` or becomes worse than the worst one around.
///
/// The faces between labels keep their triangles and points, with two exceptions: points slide inside a face
/// between two labels or along a curve where faces meet, and edges flip inside a face. By these no label
/// without layers comes to be off by more than 0.2 % of the volume that it has on the label surface, or by
/// more than it was. Points keep their order; some inside of a label are removed, new ones come last.
///
/// New edges are between 0.4 and 1.9 times the target of `sizing`, or nearer to that range than the farthest
/// of those that they replace or that moved with them. Edges of an inserted vertex, and those around tets
/// that need several operations, may be 1.5 times farther. At most one vertex for every ten, or 200, is
/// inserted. All volumes stay positive, by exact predicates. In layers, vertices are inserted only where tets
/// stay below 20 degrees after everything else.
///
/// Faces of `cuts` stay as far from the label surface as they are.
///
/// `reference` is the label surface, with the sides of the mesh's faces. ctx.note says what was done. Errors:
/// kCancelled; kOutOfMemory.
Result<TetMesh> optimise_tets(TetMesh mesh, const SurfaceMesh& reference, const SizingField& sizing,
                              const OptimiseParams& params, RunContext& ctx, const WallLayers& layers = {},
                              const CutPlanes& cuts = {});

}  // namespace voxtet
