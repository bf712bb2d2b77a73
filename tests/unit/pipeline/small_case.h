// A small body that is meshed in a moment.
#pragma once

#include "recipe/recipe.h"

namespace voxtet::test {

inline Recipe small_case() {
  Recipe recipe;
  PhantomParams& phantom = recipe.source.phantom.emplace();
  phantom.kind = PhantomKind::kNestedBoxes;
  phantom.radius_mm = 10;
  phantom.spacing_mm = Eigen::Vector3d::Constant(1);
  phantom.rotation_deg = {20, 30, 40};
  recipe.sizing.edge_mm = 3;
  return recipe;
}

}  // namespace voxtet::test
