// Planes at which an image cuts the body off.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "types/label_volume.h"

namespace voxtet {

/// While a mesh is made, the body goes on beyond the plane with a label of its own, `beyond`, so that the cut
/// is a boundary between two labels: flat, with a sharp rim. What is beyond is dropped in the end.
struct CutPlane {
  std::string name;  ///< a word, as "cut_superior"
  Label beyond = 0;
  int axis = 0;                                      ///< the index axis that it is across
  bool high = false;                                 ///< at the axis's high end
  double place = 0;                                  ///< index along that axis
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, outwards; RAS
  double offset_mm = 0;                              ///< normal . p on the plane
};

using CutPlanes = std::vector<CutPlane>;

inline bool is_beyond(const CutPlanes& cuts, Label label) {
  for (const CutPlane& cut : cuts)
    if (cut.beyond == label) return true;
  return false;
}

}  // namespace voxtet
