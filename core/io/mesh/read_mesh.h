// Files of tetrahedra -> TetMesh, for `voxtet check` and `voxtet convert`.
#pragma once

#include <string>

#include "io/bytes/volume_file.h"
#include "io/mesh/read/mesh_arrays.h"
#include "types/result.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// Reads VTU (as written by voxtet and by VTK: raw appended, base64 or ascii, uncompressed or zlib), Gmsh
/// MSH 4.1 and 2.2 (ASCII and binary), MEDIT .mesh (ASCII) and openCARP (.elem with .pts beside it). Only
/// linear tetrahedra are kept; a file with none is an error. Labels: cell array `label`, physical group,
/// reference, region: 1 to 65535; a tetrahedron without one is an error.
/// Files that say LPS (write_vtu.h, write_msh.h, write_medit.h) are turned to RAS. Points, order and
/// orientation stay as in the file (MSH: ascending tags), so that a checker sees what is there: inverted
/// tetrahedra and unused points are kept. `faces` are left empty. The format is found from the content
/// (openCARP: the name; what is missing comes from `file.sibling`). Strict: cut files, indices out of range
/// and numbers that are not finite are errors; memory is allocated only for what the bytes can hold.
/// `arrays`, where given, takes the other cell arrays of VTU and the fibres of an openCARP .lon (`fibre`,
/// `sheet`), and the names of labels that VTU, MSH and MEDIT hold; what else stands beside the files is not
/// read. Errors: kBadInput naming file, line or field.
Result<TetMesh> read_tet_mesh(const VolumeFile& file, MeshArrays* arrays = nullptr);
/// `path` may also be a.carp, for a.elem with a.pts.
Result<TetMesh> read_tet_mesh_file(const std::string& path, MeshArrays* arrays = nullptr);

}  // namespace voxtet
