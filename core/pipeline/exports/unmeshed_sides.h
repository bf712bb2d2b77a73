// What lies beyond the outer faces of a mesh, in the image that it was made from.
#pragma once

#include <vector>

#include "types/label_volume.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// Outer faces by the label of the image on their other side, where it was not meshed: the wall of a
/// ventricle towards its blood, "wall_1__blood_3". Faces towards background, and where there is none beyond,
/// are in no set. A face that is alone among others goes with them.
std::vector<NamedSet> unmeshed_sides(const TetMesh& mesh, const LabelVolume& image,
                                     const std::vector<LabelInfo>& infos);

}  // namespace voxtet
