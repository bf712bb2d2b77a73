// XDMF 2 and 3 -> TetMesh.
#pragma once

#include <string>

#include "io/bytes/volume_file.h"
#include "io/mesh/read/shared/mesh_arrays.h"
#include "types/result.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// The first grid of tetrahedra (Tetrahedron, or of Tetrahedron_10 the corners), its numbers in the text or
/// in the .h5 beside it (hdf5_file.h), which comes from `file.sibling`. Points and tetrahedra keep their
/// order. The label is the cell attribute `label`, or `label_array`; a grid without it is one region. Other
/// cell attributes of one or three components go to `arrays`. A comment of write_xdmf.h says the space and
/// the names of labels. Errors: kBadInput naming the line, or the array.
Result<TetMesh> read_xdmf(const VolumeFile& file, MeshArrays* arrays, const std::string& label_array);

}  // namespace voxtet
