// Tetrahedra -> voxels.
#pragma once

#include <span>
#include <vector>

#include "types/label_volume.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// The label at every voxel centre of `grid`, background where no tetrahedron is. `labels` has one per tet;
/// a centre on the border of several tets takes that of the lowest index whose label is not background.
std::vector<Label> rasterise(const TetMesh& mesh, std::span<const Label> labels, const LabelVolume& grid);

}  // namespace voxtet
