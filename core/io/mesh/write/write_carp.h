// openCARP's mesh files .pts, .elem, .lon (openCARP manual, "File formats").
#pragma once

#include "io/mesh/shared/mesh_format.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"

namespace voxtet {

inline constexpr double kUmPerMm = 1000;

/// .pts in um; .elem of type Tt with region = label; .lon.txt with the text kNoFibres instead of .lon;
/// .NAME.dat for each cell data, one value per line, in the order of .elem. The files have no place to state
/// their space.
std::vector<OutputFile> write_carp(const TetMesh& mesh, const WriteMeshOptions& options);

}  // namespace voxtet
