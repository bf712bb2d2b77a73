// Binary STL: triangles without names or sides, 32-bit floats (3D Systems, "Stereolithography interface
// specification").
#pragma once

#include "io/mesh/shared/mesh_format.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// mm, every triangle once, normal from the side behind to the side in front; the 80-byte header says space
/// and unit.
Bytes write_stl(const SurfaceMesh& surface, const WriteMeshOptions& options);

/// The closed boundary of each label as a file of its own, normals outwards: ".LV_myocardium_1.stl", named by
/// word_name. What lies between two labels is in both.
std::vector<OutputFile> write_label_stls(const SurfaceMesh& surface, const WriteMeshOptions& options);

}  // namespace voxtet
