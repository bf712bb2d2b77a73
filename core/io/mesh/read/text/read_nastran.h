// Nastran bulk data .bdf -> TetMesh.
#pragma once

#include "io/bytes/volume_file.h"
#include "io/mesh/read/shared/mesh_arrays.h"
#include "types/result.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// GRID and CTETRA (of ten grids the corners) in small, large and free fields, with continuations; the label
/// is the property. Points ascend by grid number, tetrahedra by element number. Other entries are skipped,
/// and so is what stands before BEGIN BULK. Comments of write_nastran.h say the space and the names of
/// labels; a file with these must end with ENDDATA. Errors: kBadInput naming the line; also for a grid in a
/// coordinate system of its own.
Result<TetMesh> read_nastran(const VolumeFile& file, MeshArrays* arrays);

}  // namespace voxtet
