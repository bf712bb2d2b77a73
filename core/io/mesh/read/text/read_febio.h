// FEBio input file .feb -> TetMesh.
#pragma once

#include "io/bytes/volume_file.h"
#include "io/mesh/read/shared/mesh_arrays.h"
#include "types/result.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// <Nodes> and <Elements> of type tet4 and tet10 (of ten nodes the corners) of versions 2.5 to 4.0; others
/// are skipped. Points ascend by node id, tetrahedra by element id. A label for each part, by its name
/// (labels_of_parts in found_labels.h; the names go to `arrays`). A comment of write_febio.h says the space.
/// Errors: kBadInput naming the line or the id.
Result<TetMesh> read_febio(const VolumeFile& file, MeshArrays* arrays);

}  // namespace voxtet
