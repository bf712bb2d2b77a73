// Abaqus input file .inp -> TetMesh.
#pragma once

#include "io/bytes/volume_file.h"
#include "io/mesh/read/shared/mesh_arrays.h"
#include "types/result.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// *NODE and *ELEMENT with the types C3D4 and C3D10, and their variants (of ten nodes the corners); others
/// are skipped. Points ascend by node number, tetrahedra by element number. A label for each element set:
/// that of the *ELEMENT block, or where no block has one those of *SOLID SECTION (labels_of_parts in
/// found_labels.h; the names go to `arrays`). Comments of write_abaqus.h say the space, and how many there
/// must be. Errors: kBadInput naming the line.
Result<TetMesh> read_abaqus(const VolumeFile& file, MeshArrays* arrays);

}  // namespace voxtet
