// Binary little-endian PLY (G. Turk, "The PLY polygon file format", 1994).
#pragma once

#include "io/mesh/shared/mesh_format.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// Vertices in double, mm; each face has its corners and then the properties `label_behind` and `label_front`
/// (ushort). Comments say space, unit, and the names of the labels.
Bytes write_ply(const SurfaceMesh& surface, const WriteMeshOptions& options);

}  // namespace voxtet
