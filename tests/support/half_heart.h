// Two generated ventricles of half the size, for the stages of physics.
#pragma once

#include "recipe/recipe.h"

namespace voxtet::test {

/// With named surfaces and fibres.
inline Recipe half_heart(double edge_mm) {
  Recipe recipe;
  PhantomParams& phantom = recipe.source.phantom.emplace();
  phantom.kind = PhantomKind::kBiventricle;
  phantom.scale = 0.5;
  phantom.roughness_mm = 0;
  recipe.labels = {1, 2};
  recipe.sizing.edge_mm = edge_mm;
  PhysicsParams& physics = recipe.physics.emplace();
  physics.anatomy.emplace();
  physics.fibres.emplace();
  return recipe;
}

}  // namespace voxtet::test
