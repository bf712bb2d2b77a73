// openCARP's mesh files .pts, .elem, .lon (openCARP manual, "File formats").
#pragma once

#include "io/mesh/shared/mesh_format.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"

namespace voxtet {

inline constexpr double kUmPerMm = 1000;

/// .pts in um; .elem of type Tt with region = label; .lon with the cell data kFibreField and, where there is
/// one, kSheetField, a line for each element; without them .lon.txt with the text kNoFibres. .NAME.dat for
/// each other field, a line for each element of .elem or point of .pts. For each surface .NAME.surf, its
/// triangles (Tr), and .NAME.surf.vtx, their points. The files have no place to state their space.
std::vector<OutputFile> write_carp(const TetMesh& mesh, const WriteMeshOptions& options);

}  // namespace voxtet
