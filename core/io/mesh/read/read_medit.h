// MEDIT .mesh (ASCII) -> TetMesh.
#pragma once

#include "io/bytes/volume_file.h"
#include "io/mesh/read/mesh_arrays.h"
#include "types/result.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// Vertices and Tetrahedra; other sections are skipped, End is required. A comment line "# space LPS" is
/// obeyed.
Result<TetMesh> read_medit(const VolumeFile& file);

}  // namespace voxtet
