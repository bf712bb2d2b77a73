// VTK's XML UnstructuredGrid: binary, appended, raw (VTK file formats, "XML File Formats").
#pragma once

#include <cstdint>
#include <string_view>

#include "io/mesh/shared/mesh_format.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// VTK's number of the cell type.
inline constexpr std::uint8_t kVtkTetra = 10, kVtkQuadraticTetra = 24;

/// Field data that hold the names of labels.
inline constexpr std::string_view kLabelValues = "label_values", kLabelNames = "label_names";

/// Tetrahedra with the Int32 cell array `label` and cell data as Float32; Float64 points, mm. A comment at
/// the beginning says space and unit to people. In LPS the grid has a field-data array `space` of three Int8
/// letters, "LPS"; without it a file is RAS. Names of labels are field data too: `label_values`, Int32, and
/// `label_names`, the bytes of their names with a zero behind each. (No VTK strings: meshio refuses files
/// with them.)
Bytes write_vtu(const TetMesh& mesh, const WriteMeshOptions& options);

/// Triangles with the Int32 cell arrays `label_behind` and `label_front`, and `surface` where there are named
/// surfaces: from 1 in their order, which the comment gives with their names; 0 outside of all.
Bytes write_vtu(const SurfaceMesh& surface, const WriteMeshOptions& options);

}  // namespace voxtet
