// Legacy VTK -> TetMesh.
#pragma once

#include <string>

#include "io/bytes/volume_file.h"
#include "io/mesh/read/shared/mesh_arrays.h"
#include "types/result.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// UNSTRUCTURED_GRID of versions 2.0 to 5.1, ASCII and binary: linear tetrahedra, and the corners of
/// quadratic ones; other cells are skipped. Points and tetrahedra keep their order. The label is the cell
/// array `label`, or `label_array`; a file without it is one region. Other cell arrays of one or three
/// components go to `arrays`, and the names of labels. The title of write_vtk.h says the space. Errors:
/// kBadInput naming line or byte; also for arrays of texts in binary files.
Result<TetMesh> read_vtk(const VolumeFile& file, MeshArrays* arrays, const std::string& label_array);

}  // namespace voxtet
