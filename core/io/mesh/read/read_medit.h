// MEDIT .mesh (ASCII) -> TetMesh.
#pragma once

#include "io/bytes/volume_file.h"
#include "io/mesh/read/shared/mesh_arrays.h"
#include "types/result.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// Vertices and Tetrahedra; other sections are skipped, End is required. A comment line "# space LPS" is
/// obeyed, and those of names ("# tetrahedra 1 LV"), which `arrays` takes where it is given.
Result<TetMesh> read_medit(const VolumeFile& file, MeshArrays* arrays);

}  // namespace voxtet
