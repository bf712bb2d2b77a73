// Surfaces of label volumes, smoothed.
#pragma once

#include <gtest/gtest.h>

#include <utility>

#include "surface/smooth/smooth_surface.h"

namespace voxtet::test {

inline SurfaceMesh smooth(const SurfaceMesh& surface, const LabelVolume& volume,
                          const SmoothParams& params = {}) {
  RunContext ctx;
  Result<SurfaceMesh> result = smooth_surface(surface, volume, params, ctx);
  if (!result) {
    ADD_FAILURE() << result.error().message;
    return surface;
  }
  return std::move(result).value();
}

}  // namespace voxtet::test
