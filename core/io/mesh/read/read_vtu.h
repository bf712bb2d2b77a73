// VTK XML UnstructuredGrid (.vtu) -> TetMesh.
#pragma once

#include <string>

#include "io/bytes/volume_file.h"
#include "io/mesh/read/shared/mesh_arrays.h"
#include "types/result.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// Linear tetrahedra of all pieces; the label is the cell array `label` (any numeric type, whole numbers).
/// Little-endian, ascii, base64 or raw, inline or appended, uncompressed or zlib. A field-data array `space`
/// that says "LPS" is obeyed. `arrays` and `label_array` as in read_tet_mesh.
Result<TetMesh> read_vtu(const VolumeFile& file, MeshArrays* arrays, const std::string& label_array);

}  // namespace voxtet
