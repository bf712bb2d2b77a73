// What the voxels say about each tetrahedron of a mesh that was made of other labels.
#pragma once

#include <vector>

#include "types/field.h"
#include "types/label_volume.h"

namespace voxtet {

/// One label that was transferred. The volumes are those of the tets that would carry it: each by its
/// fraction, or whole by the label at its centroid, or whole by its majority.
struct TransferredLabel {
  Label label = 0;
  double voxel_mm3 = 0;
  double fraction_mm3 = 0, centroid_mm3 = 0, majority_mm3 = 0;
  double centroid_dice = 0, majority_dice = 0;  ///< at voxel centres, tets against voxels
};

/// Empty throughout when nothing was asked for. Fields of tetrahedra: `centroid_label`, at the centroid, and
/// `majority_label`, of most samples, labels of the image with background among them; then for each of
/// `labels`, as `fraction_5` for label 5, its share of the tetrahedron, in [0, 1].
struct LabelTransfer {
  std::vector<TransferredLabel> labels;  ///< those asked for, ascending
  std::vector<Field> fields;

  const std::vector<float>& centroid() const { return fields[0].values; }
  const std::vector<float>& majority() const { return fields[1].values; }
  /// Shares of labels[i].
  const std::vector<float>& fraction(std::size_t i) const { return fields[2 + i].values; }
};

}  // namespace voxtet
