// XDMF 3 with its numbers in HDF5 (https://xdmf.org, "XDMF Model and Format").
#pragma once

#include "io/mesh/shared/mesh_format.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// .xdmf: one grid, "mesh", with the cell attribute `label` and cell data as further cell attributes; .h5,
/// which it names: points (Float64, mm), tets and label (Int32), cell data (Float32). A comment of the .xdmf
/// says space and unit. Faces: .facets.xdmf and .facets.h5, one grid, "facets", of all triangles on
/// the same points, with the attribute `facet` (Int32), the tag of each (facet_tags.h); the comment gives
/// what the tags mean. That is how FEniCSx reads facets (read_meshtags); a second grid in one file, which it
/// takes too, meshio refuses. (HDF5 and not raw binary: that FEniCS does not read, and meshio looks for it in
/// the working folder.) Errors: kUsage for an options.name that is empty, begins or ends with a space, or
/// holds a colon or a control character: the reference "NAME.h5:/points" would not be found.
Result<std::vector<OutputFile>> write_xdmf(const TetMesh& mesh, const WriteMeshOptions& options);

}  // namespace voxtet
