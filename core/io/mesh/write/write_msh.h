// Gmsh MSH 4.1, binary (Gmsh reference manual, "MSH file format").
#pragma once

#include "io/mesh/shared/mesh_format.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// mm. One volume entity per label, tag and physical group = label; one surface entity per pair of sides, tag
/// and physical group = its rank among the pairs (from 1), named "LV|background". A named surface is a
/// further physical group, and what it has of each pair of sides a surface entity of its own, which is in
/// both groups. Node tag = point index + 1; element tags number the tets first, then the faces, in the mesh's
/// order. Surfaces bound their volumes with the sign of the outward normal. Cell data: a second file,
/// _data.msh, with one $ElementData each, that Gmsh merges with the first. (Not in one file: meshio takes
/// element data only for all elements, faces too, in the order of its blocks.) A $Comments section says
/// "space RAS" or "space LPS", and "unit mm".
std::vector<OutputFile> write_msh(const TetMesh& mesh, const WriteMeshOptions& options);

}  // namespace voxtet
