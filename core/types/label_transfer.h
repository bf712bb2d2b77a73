// Labels of the image given to the tetrahedra of a mesh that does not follow them.
#pragma once

#include <vector>

#include "types/field.h"
#include "types/label_volume.h"

namespace voxtet {

/// One transferred label. Besides its volume in voxels, the volume of the tetrahedra that carry it, in three
/// ways: each tetrahedron counts by its fraction, or as a whole where the label is at its centroid, or as a
/// whole where the label has the majority.
struct TransferredLabel {
  Label label = 0;
  double voxel_mm3 = 0;
  double fraction_mm3 = 0, centroid_mm3 = 0, majority_mm3 = 0;
  double centroid_dice = 0, majority_dice = 0;  ///< Dice of tetrahedra against voxels, sampled at voxel
                                                ///< centres
};

/// Empty if no label was asked for. All fields are on tetrahedra. `centroid_label` is the label at the
/// centroid, `majority_label` the label of most samples; both may be any label of the image, background too.
/// For each of `labels` follows its share of the tetrahedron, in [0, 1], named `fraction_5` for label 5.
struct LabelTransfer {
  std::vector<TransferredLabel> labels;  ///< those asked for, ascending
  std::vector<Field> fields;

  const std::vector<float>& centroid() const { return fields[0].values; }
  const std::vector<float>& majority() const { return fields[1].values; }
  /// The share of labels[i] in each tetrahedron.
  const std::vector<float>& fraction(std::size_t i) const { return fields[2 + i].values; }
};

}  // namespace voxtet
