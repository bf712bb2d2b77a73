// Legacy VTK 3.0, ASCII (VTK User's Guide, "VTK File Formats", "Simple Legacy Formats"), which many programs
// and scripts read that know no VTU.
#pragma once

#include <string_view>

#include "io/mesh/shared/mesh_format.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// How the title line, the second, begins; the name of the space follows, and then the axes.
inline constexpr std::string_view kVtkTitle = "voxtet mesh, space ";

/// UNSTRUCTURED_GRID of tetrahedra with the cell array `label` (SCALARS, int), cell and point data as FIELD
/// arrays of floats; points in mm that read back exactly. The title line says space and unit. Names of labels
/// are field data as in VTU (write_vtu.h): `label_values`, and `label_names` with a zero behind each.
Bytes write_vtk(const TetMesh& mesh, const WriteMeshOptions& options);

/// Triangles with the cell arrays `label_behind` and `label_front`, and `surface` where there are named
/// surfaces: from 1 in their order, 0 outside of all. Their names are field data: `surface_names`, with a
/// zero behind each.
Bytes write_vtk(const SurfaceMesh& surface, const WriteMeshOptions& options);

}  // namespace voxtet
