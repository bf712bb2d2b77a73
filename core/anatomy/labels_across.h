// Outer faces of a mesh, named by what the image holds beyond them.
#pragma once

#include <functional>
#include <vector>

#include "types/label_volume.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// For each face of the mesh the label across it: that of the tetrahedra in front (sides[1]) if there are
/// any, else the label of the image there, 0 for background. `image` holds all of its labels, in the
/// place of the mesh. A face in front of a blood pool that was not meshed thus knows which pool it is.
/// Labels of which the mesh holds most voxels, also under another label, are taken for the mesh's own side.
std::vector<Label> labels_across(const TetMesh& mesh, const LabelVolume& image);

namespace anatomy {

/// Whether, of each of the 65536 labels, most voxels of the image lie in tetrahedra with labels of which
/// `counts` approves. Never of background.
std::vector<bool> labels_within(const TetMesh& mesh, const LabelVolume& image,
                                const std::function<bool(Label)>& counts);

}  // namespace anatomy
}  // namespace voxtet
