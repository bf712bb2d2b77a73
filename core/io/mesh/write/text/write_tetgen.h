// TetGen's files .node, .ele and .face (H. Si, "TetGen Users' Manual", "File formats").
#pragma once

#include "io/mesh/shared/mesh_format.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// Numbers count from 1; mm, coordinates that read back exactly. .ele: one attribute, the label, a whole
/// number (no cell data: meshio reads attributes that are real as none). .face: the marker is the facet tag
/// (facet_tags.h). Comments ("#") give space and unit in .node, the names of labels in .ele and those of
/// markers in .face (in_ascii).
std::vector<OutputFile> write_tetgen(const TetMesh& mesh, const WriteMeshOptions& options);

}  // namespace voxtet
