// Gmsh MSH 4.1 and 2.2, ASCII and binary -> TetMesh.
#pragma once

#include <string>

#include "io/bytes/volume_file.h"
#include "io/mesh/read/shared/mesh_arrays.h"
#include "types/result.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// Points ascend by node tag, tetrahedra by element tag. The label is the (first) physical group, or where no
/// tetrahedron is in one the geometric entity; `label_array`, "gmsh:physical" or "gmsh:geometrical", says
/// which (meshio's names for them). Elements of other types are skipped; unknown sections too. A $Comments
/// section "space LPS" is obeyed. `arrays`, where given, takes the names of the physical groups.
Result<TetMesh> read_msh(const VolumeFile& file, MeshArrays* arrays, const std::string& label_array);

}  // namespace voxtet
