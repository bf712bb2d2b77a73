// How true a finished mesh is to its voxels, in figures.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "pipeline/session.h"
#include "sweep/fidelity/reference.h"

namespace voxtet::sweep {

/// Runs a case up to the mesh and measures it. A row of the JSON file, by these names; distances in voxels
/// (smallest spacing), label by label, `to` from the mesh's label boundaries to a surface, `from` back:
/// - `reference`: digest of what the mesh is measured against
/// - `tets`, `triangles`; `seconds`: of the processor, by stage
/// - `to_smoothed`, `from_smoothed`, `to_voxels`, `from_voxels`: {mean, max}
/// - `dice`, `volume_percent` (what the mesh has too much): by label
/// - `dihedral_deg`: {least, p01}, of each tetrahedron's smallest angle
/// - `ledger`: in words, how the labels' topology differs from that of the reference
Result<nlohmann::json> measure_fidelity(const std::string& name, const ReferenceFolders& folders,
                                        Session& session);

}  // namespace voxtet::sweep
