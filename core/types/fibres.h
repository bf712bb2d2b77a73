// Directions of muscle fibres and of the sheets that they form.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace voxtet {

/// One entry for each tetrahedron, or for each point: unit vectors, at right angles to each other, whose
/// signs mean nothing. Zero where there is no muscle.
struct Fibres {
  std::vector<Eigen::Vector3d> fibre;
  std::vector<Eigen::Vector3d> sheet;  ///< in the plane of the sheet, across the fibre
};

}  // namespace voxtet
