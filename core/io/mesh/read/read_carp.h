// openCARP .elem and .pts -> TetMesh, with the directions of .lon.
#pragma once

#include "io/bytes/volume_file.h"
#include "io/mesh/read/shared/mesh_arrays.h"
#include "types/result.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// `file` is the .elem, the .pts or the .lon of a mesh; the other files come from `file.sibling`. Um are
/// converted to mm; only Tt elements are kept, and each needs its region. `arrays`, where given, takes the
/// directions of the .lon as kFibreField and kSheetField; zero where an element has none. A mesh without a
/// .lon has no such fields.
Result<TetMesh> read_carp(const VolumeFile& file, MeshArrays* arrays);

}  // namespace voxtet
