// TetGen's files .node, .ele and .face (H. Si, "TetGen Users' Manual", "File formats").
#pragma once

#include "io/mesh/shared/mesh_format.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// Numbers count from 1; mm, coordinates that read back exactly. .ele: the first attribute is the label, and
/// each of the cell data is a further one. .face: the marker is the facet tag (facet_tags.h). Comments ("#")
/// give space and unit in .node, and the names of labels, attributes and markers in .ele and .face.
std::vector<OutputFile> write_tetgen(const TetMesh& mesh, const WriteMeshOptions& options);

}  // namespace voxtet
