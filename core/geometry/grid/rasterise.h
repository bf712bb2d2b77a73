// Tetrahedra -> voxels.
#pragma once

#include <span>
#include <vector>

#include "types/label_volume.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// The label at every voxel centre of `grid`, background where there is no tetrahedron. `labels` has one per
/// tet. A centre on the border of several tets gets the label of the lowest index that is not background.
std::vector<Label> rasterise(const TetMesh& mesh, std::span<const Label> labels, const LabelVolume& grid);

}  // namespace voxtet
