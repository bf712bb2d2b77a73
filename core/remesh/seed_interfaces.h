// First points on every interface, so that the refinement finds all of them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "remesh/label_field.h"
#include "types/sizing_field.h"

namespace voxtet::remesh {

struct Seeds {
  std::vector<Eigen::Vector3d> points;  ///< mm, on the interfaces
  double predicted_vertices = 0;        ///< rough size of the finished surface, for progress
};

/// Poisson-spaced points (kSeedSpacing wished edge lengths apart) on the interface of every pair of touching
/// 6-connected components, at least eight each where the lattice offers as many. Fixed order.
Seeds seed_interfaces(const LabelField& field, const SizingField& sizing);

inline constexpr double kSeedSpacing = 2.5;

}  // namespace voxtet::remesh
