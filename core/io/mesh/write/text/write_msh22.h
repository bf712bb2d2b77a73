// Gmsh MSH 2.2, ASCII (Gmsh reference manual, "Legacy formats"), for programs that know no later version.
#pragma once

#include "io/mesh/shared/mesh_format.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// mm, numbers that read back exactly. Node number = point index + 1; element numbers count the tetrahedra
/// first, then the faces, in the mesh's order. Tetrahedra: physical group and elementary tag = label. Faces:
/// physical group = facet tag (facet_tags.h), so that each face stands in the file once; the elementary tag
/// tells faces apart that differ in their two sides or their named surface. All groups are named. A $Comments
/// section says "space RAS" or "space LPS", and "unit mm". Cell data: a second file, _data.msh, with one
/// $ElementData each, that Gmsh merges with the first.
std::vector<OutputFile> write_msh22(const TetMesh& mesh, const WriteMeshOptions& options);

}  // namespace voxtet
