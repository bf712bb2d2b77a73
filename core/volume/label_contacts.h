// How labels lie to each other in a segmented image: what is around what.
#pragma once

#include <cstdint>
#include <vector>

#include "types/label_volume.h"

namespace voxtet {

/// A label on the other side of a label's boundary.
struct LabelContact {
  Label other = kBackground;  ///< background too
  double share = 0;           ///< of the label's boundary, by area
};

struct LabelSurroundings {
  Label label = kBackground;
  std::vector<LabelContact> contacts;  ///< the largest first; what lies beyond the image is none
  double border_share = 0;             ///< the part of the image's border voxels that have this label
};

/// Of each label that the image holds but the background, ascending. Areas are those of voxel faces.
std::vector<LabelSurroundings> label_surroundings(const LabelVolume& volume);

}  // namespace voxtet
