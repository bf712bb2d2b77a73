// Abaqus input file .inp, as CalculiX reads it too (Abaqus, "Keywords Reference Guide"; G. Dhondt, "CalculiX
// CrunchiX User's Manual").
#pragma once

#include "io/mesh/shared/mesh_format.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// The mesh alone, for a model that includes it: *NODE in mm, *ELEMENT of type C3D4 with one element set per
/// label, *SURFACE of type ELEMENT per pair of sides, on the element of the greater label, so that its normal
/// points from the first name to the second, and one per named surface. Node number = point index + 1,
/// element number = place in the mesh + 1. Sets and surfaces are named by word_name. Comments give
/// space, unit, and the numbers of nodes and elements, so that a cut file is noticed. Numbers have at most
/// the format's 20 characters: coordinates below 0.1 mm are rounded to 1e-15 mm, others read back exactly.
/// Cell data: one .NAME.inp each, with the data lines of a *DISTRIBUTION with LOCATION=ELEMENT and INPUT=file
/// (default 0 first). Errors: kInternal for a face that is no side of a tetrahedron (face_owners.h).
Result<std::vector<OutputFile>> write_abaqus(const TetMesh& mesh, const WriteMeshOptions& options);

}  // namespace voxtet
