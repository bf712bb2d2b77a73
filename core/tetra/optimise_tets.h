// Tetrahedra -> better-shaped tetrahedra of the same domain.
// M. Klingner and J. R. Shewchuk 2007
#pragma once

#include "types/result.h"
#include "types/run_context.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"

namespace voxtet {

struct OptimiseParams {
  double min_dihedral_deg = 35;  ///< tets with a dihedral angle below this are worked on
  double insertion_deg = 30;     ///< vertices are inserted at tets that stay below this
  int rounds = 4;
};

Result<TetMesh> optimise_tets(TetMesh mesh, const SurfaceMesh& reference, const SizingField& sizing,
                              const OptimiseParams& params, RunContext& ctx);

}  // namespace voxtet
