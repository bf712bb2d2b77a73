// FEBio input file .feb of version 4.0 (S. Maas et al., "FEBio User's Manual", "Free Format Input").
#pragma once

#include "io/mesh/shared/mesh_format.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// The mesh with what FEBio asks for beside it; analysis, boundary conditions and loads are the user's. One
/// Elements section of type tet4 per label, a solid domain and a material each; a Surface of tri3 per pair of
/// sides, normal from the first to the second; all named by word_name. Node id = point index + 1, element id
/// = place in the mesh + 1. The module's units are mm-kg-s, so stresses are kPa; a comment says the space.
/// Every material is neo-Hookean, E 10 kPa, v 0.45, 1060 kg/m^3: values to begin with, as a comment says.
/// Cell data: an ElementData section per part, so that a parameter of type "map" may name them.
Bytes write_febio(const TetMesh& mesh, const WriteMeshOptions& options);

}  // namespace voxtet
