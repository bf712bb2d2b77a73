// Nastran bulk data .bdf (MSC, "Quick Reference Guide", "Bulk Data Entries").
#pragma once

#include "io/mesh/shared/mesh_format.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// The bulk data of the mesh alone. GRID* in large fields: of 16 characters, so that coordinates below 100 m
/// are rounded to at most 1e-8 mm, and those below 1 m to 1e-11; CTETRA with property = label, a PSOLID for
/// each label with the material of the same number, which the user gives (MAT1). Grid number = point index +
/// 1, element number = place in the mesh + 1. Surfaces are loads: PLOAD4 of unit pressure, load set = facet
/// tag (facet_tags.h), on the element behind the face; a load set acts only where a case selects it. Comments
/// give space and unit, and the names of labels and surfaces (in_ascii). Errors: kUsage for more points or
/// tetrahedra than have numbers of eight digits; kInternal for a face that is no side of a tetrahedron.
Result<std::vector<OutputFile>> write_nastran(const TetMesh& mesh, const WriteMeshOptions& options);

}  // namespace voxtet
