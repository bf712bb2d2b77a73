// What the voxels say about each tetrahedron of a mesh that was made of other labels.
#pragma once

#include <vector>

#include "types/label_volume.h"

namespace voxtet {

/// One label that was looked up. The volumes are those of the tets that would carry it: each by its fraction,
/// or whole by the label at its centroid, or whole by its majority.
struct LookedUpLabel {
  Label label = 0;
  std::vector<float> fraction;  ///< one per tet, in [0, 1]: the label's share of it
  double voxel_mm3 = 0;
  double fraction_mm3 = 0, centroid_mm3 = 0, majority_mm3 = 0;
  double centroid_dice = 0, majority_dice = 0;  ///< at voxel centres, tets against voxels
};

/// Empty throughout when nothing was asked for; else labels of the image, background among them, for each
/// tet.
struct LabelLookUp {
  std::vector<Label> centroid;        ///< at the tet's centroid
  std::vector<Label> majority;        ///< of most of the tet's samples
  std::vector<LookedUpLabel> labels;  ///< those asked for, ascending
};

}  // namespace voxtet
