// Planes at which a body is cut off: by its image's border, or where the user asks for it.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "types/label_volume.h"

namespace voxtet {

/// While a mesh is made, the body goes on beyond the plane with a label of its own, `beyond`, so that the cut
/// is a boundary between two labels: flat, with a sharp rim. What is beyond is dropped in the end.
struct CutPlane {
  std::string name;  ///< a word, as "cut_superior"
  Label beyond = 0;
  int axis = 0;                                      ///< border: the index axis that it is across
  bool high = false;                                 ///< border: at the axis's high end
  double place = 0;                                  ///< border: index along that axis
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, outwards; RAS
  double offset_mm = 0;                              ///< normal . p on the plane
  std::vector<Label> labels{};                       ///< that are cut, by a plane that was asked for
  double reach_mm = 0;  ///< of such a plane: what is farther beyond it is left out from the start

  /// Whether it was asked for, and is not the image's border.
  bool is_given() const { return !labels.empty(); }
  bool cuts(Label label) const { return std::find(labels.begin(), labels.end(), label) != labels.end(); }
  /// How far beyond the plane a point is, mm; negative on the side that stays.
  double distance_mm(const Eigen::Vector3d& point) const { return normal.dot(point) - offset_mm; }
};

using CutPlanes = std::vector<CutPlane>;
/// Of a point: bit i for the cut i.
using CutBits = std::uint16_t;
inline constexpr std::size_t kMostCuts = 16;

inline bool is_beyond(const CutPlanes& cuts, Label label) {
  for (const CutPlane& cut : cuts)
    if (cut.beyond == label) return true;
  return false;
}

inline CutPlanes cuts_of_border(CutPlanes cuts) {
  std::erase_if(cuts, [](const CutPlane& cut) { return cut.is_given(); });
  return cuts;
}

}  // namespace voxtet
