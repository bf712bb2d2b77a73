// TetGen's .node with .ele -> TetMesh.
#pragma once

#include "io/bytes/volume_file.h"
#include "io/mesh/read/shared/mesh_arrays.h"
#include "types/result.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// `file` is either of them; the other comes from `file.sibling`. Numbers may count from 0 or 1. The label is
/// the first attribute of .ele, and without attributes all is one region; further attributes go to `arrays`
/// as attribute_2, ... Of ten nodes the corners are read.
/// Comments of write_tetgen.h say the space and the names of labels. Errors: kBadInput naming file and line.
Result<TetMesh> read_tetgen(const VolumeFile& file, MeshArrays* arrays);

}  // namespace voxtet
