// What is written with the mesh of a session into its file.
#pragma once

#include <string>
#include <vector>

#include "io/mesh/write_mesh.h"
#include "pipeline/session.h"

namespace voxtet {

struct Exported {
  WriteMeshOptions options;           ///< all but the space and the name of the file
  std::vector<std::string> left_out;  ///< names of the fields and surfaces that the format has no place for
};

/// What goes with Session::mesh() into a file of a format. On the tetrahedra: the fields of the label
/// transfer, fibres and, with `measures`, the fields of the quality report that have a finite value
/// everywhere. On the points: what simulations found. And the named surfaces of the anatomy.
Exported exported_fields(const Session& session, MeshFormat format, bool measures);

}  // namespace voxtet
