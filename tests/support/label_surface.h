// The smoothed label surface of a volume, as the later stages take it.
#pragma once

#include "surface/extract/extract_surface.h"
#include "surface/smooth/smooth_surface.h"

namespace voxtet::test {

inline SurfaceMesh label_surface(const LabelVolume& volume, const SmoothParams& params = {}) {
  RunContext ctx;
  return smooth_surface(extract_surface(volume, {}, ctx).value(), volume, params, ctx).value();
}

}  // namespace voxtet::test
