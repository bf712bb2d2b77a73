// Tetrahedra -> better-shaped tetrahedra of the same domain.
// B. M. Klingner and J. R. Shewchuk, "Aggressive tetrahedral mesh improvement", 16th International Meshing
// Roundtable (2007).
#pragma once

#include "types/result.h"
#include "types/run_context.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"
#include "walls/wall_layers.h"

namespace voxtet {

struct OptimiseParams {
  double min_dihedral_deg = 35;  ///< tets with a dihedral angle below this are worked on
  double insertion_deg = 33;     ///< at those that stay below this vertices are inserted and slide
  int rounds = 4;                ///< 0 leaves the mesh as it is
  /// How far a vertex that slides or the middle of an edge that flips may be from the label surface, as a
  /// part of the target edge length, where it is not already; 0: the boundary stays as it is.
  double slide = 0.1;
};

/// Works on the worst tets first: removes edges and faces, moves vertices, inserts vertices, and does several
/// of these together where none helps alone. What is done raises the lowest quality
/// (tetra/mesh/tet_quality.h) around it. In the end vertices move where their edges are nearer to their
/// targets, as far as no tet falls below `min_dihedral_deg` or becomes worse than the worst around. The faces
/// between labels keep their triangles and points, but for points that slide inside a face between two labels
/// or along a curve where faces meet, and edges that flip inside a face; no label without layers gains or
/// loses more than 0.2 % of its volume by these. Points keep their order; some inside of a label go, new ones
/// come last. New edges are between 0.4 and 1.9 times the target of `sizing`, or nearer to that than the
/// farthest of those they replace or that moved with them; those of an inserted vertex, and those around tets
/// that need several operations, may be 1.5 times farther. No more than one vertex for every ten, or 200, is
/// inserted. All volumes stay positive, by exact predicates. In layers, vertices are inserted only where tets
/// stay below 25 degrees after all else. `reference` is the label surface, with the sides of the mesh's
/// faces. ctx.note says what was done. Errors: kCancelled; kOutOfMemory.
Result<TetMesh> optimise_tets(TetMesh mesh, const SurfaceMesh& reference, const SizingField& sizing,
                              const OptimiseParams& params, RunContext& ctx, const WallLayers& layers = {});

}  // namespace voxtet
