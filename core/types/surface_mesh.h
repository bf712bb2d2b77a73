// A labelled triangle complex: the boundary of every label at once, non-manifold by design.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "types/label_volume.h"

namespace voxtet {

using Triangle = std::array<std::uint32_t, 3>;
/// {label behind, label in front}: the right-hand normal of the triangle points from the first to the second.
using Sides = std::array<Label, 2>;

/// Points in mm, RAS. Each triangle separates two different labels (0 = background). The triangles that have
/// label k on exactly one side form the closed boundary of k. Invariant in every stage's output: the two
/// sides differ, every point is used, sides[t][0] > sides[t][1] (so the boundary of a lone label points
/// outwards).
struct SurfaceMesh {
  std::vector<Eigen::Vector3d> points;
  std::vector<Triangle> triangles;
  std::vector<Sides> sides;  ///< one per triangle
};

}  // namespace voxtet
