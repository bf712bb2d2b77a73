// Files of tetrahedra -> TetMesh, for `voxtet check` and `voxtet convert`.
#pragma once

#include <string>

#include "io/bytes/volume_file.h"
#include "io/mesh/read/shared/mesh_arrays.h"
#include "types/result.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// Reads VTU (as written by voxtet and by VTK: raw appended, base64 or ascii, uncompressed or zlib), legacy
/// VTK (ASCII and binary), Gmsh MSH 4.1 and 2.2 (ASCII and binary), MEDIT .mesh (ASCII), XDMF (numbers in the
/// text or in an .h5 without compression), Abaqus .inp, Nastran .bdf, FEBio .feb, TetGen (.ele with .node
/// beside it) and openCARP (.elem with .pts beside it). Only tetrahedra are kept, of quadratic ones the
/// corners; a file with none is an error. Labels: cell array `label`, or `label_array` (of VTU, VTK, XDMF and
/// MSH), physical group, reference, part, property, attribute, region. A file without labels is one region,
/// and a value that is no label, 1 to 65535, becomes a free one (found_labels.h): notes of `arrays` say so.
/// Files that say LPS are turned to RAS. Points, order and orientation stay as in the file (where points or
/// tetrahedra are numbered: ascending), so that a checker sees what is there: inverted tetrahedra and unused
/// points are kept. `faces` are left empty. The format is found from the content, openCARP and TetGen from
/// the name; what is missing comes from `file.sibling`. Strict: cut files, indices out of range and numbers
/// that are not finite are errors; memory is allocated only for what the bytes can hold. `arrays`, where
/// given, takes the other cell arrays of VTU, VTK, XDMF and TetGen, the fibres of an openCARP .lon (`fibre`,
/// `sheet`), and the names of labels; what else stands beside the files is not read. Errors: kBadInput naming
/// file, line or field; kUsage for a `label_array` of a format that has none.
Result<TetMesh> read_tet_mesh(const VolumeFile& file, MeshArrays* arrays = nullptr,
                              const std::string& label_array = {});
/// `path` may also be a.carp, for a.elem with a.pts.
Result<TetMesh> read_tet_mesh_file(const std::string& path, MeshArrays* arrays = nullptr,
                                   const std::string& label_array = {});

}  // namespace voxtet
