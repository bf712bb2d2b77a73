// How well a mesh keeps the labels: volumes, overlap, sizes.
#pragma once

#include <map>
#include <vector>

#include "types/label_volume.h"
#include "types/quality_report.h"
#include "types/sizing_field.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// One entry per label of volume or mesh, ascending. `more_mm3`: by label, what is to be added to the volume
/// of its voxels.
std::vector<LabelFidelity> measure_labels(const TetMesh& mesh, const LabelVolume& volume,
                                          const SizingField& sizing,
                                          const std::map<Label, double>& more_mm3 = {});

}  // namespace voxtet
