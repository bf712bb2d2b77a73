// MEDIT / Gamma Mesh Format .mesh, ASCII (P. Frey, "MEDIT: an interactive mesh visualization software", INRIA
// RT-0253).
#pragma once

#include "io/mesh/shared/mesh_format.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// mm, numbers that read back exactly. Tetrahedra with reference = label; triangles with reference = rank of
/// their pair of sides (from 1). Comment lines ("#") say the space and what each reference means.
/// Cell data: a .sol with one scalar each per tetrahedron ("SolAtTetrahedra"); a comment lists their names.
std::vector<OutputFile> write_medit(const TetMesh& mesh, const WriteMeshOptions& options);

}  // namespace voxtet
