// A generated heart of 256 voxels' length, on which thickness and gradation are timed.
#pragma once

#include <algorithm>

#include "geometry/grid/fast_sweeping.h"
#include "phantom/make_phantom.h"
#include "surface/extract/extract_surface.h"
#include "surface/smooth/smooth_surface.h"
#include "walls/measure_wall.h"

namespace voxtet::test {

/// 256 x 215 x 219 voxels, three million of them in the wall (labels 1 and 2; 3 and 4 are the blood pools).
struct LargeHeart {
  LabelVolume anatomy, meshed;
  SurfaceMesh surface;  ///< of the wall alone, smoothed

  LargeHeart() {
    PhantomParams params;
    params.spacing_mm.setConstant(0.36);
    anatomy = make_phantom(params).value();
    meshed = anatomy;
    std::replace_if(
        meshed.labels.begin(), meshed.labels.end(), [](Label label) { return label > 2; }, kBackground);
    RunContext ctx;
    surface = smooth_surface(extract_surface(meshed, {}, ctx).value(), meshed, {}, ctx).value();
  }

  Result<WallField> wall(RunContext& ctx) const {
    return measure_wall({anatomy, meshed, surface}, {{1, 2}, {3, 4}}, "sizing.thickness[0]", ctx);
  }

  static constexpr int kFieldSize = 256;  ///< of the field of sizes, along each axis

  /// Sizes in mm of which the right ventricle's are half those of the left one, all others large.
  std::vector<float> target_sizes() const {
    std::vector<float> target(static_cast<std::size_t>(kFieldSize) * kFieldSize * kFieldSize, 50.F);
    for (int k = 0; k < anatomy.size[2]; ++k)
      for (int j = 0; j < anatomy.size[1]; ++j)
        for (int i = 0; i < std::min(anatomy.size[0], kFieldSize); ++i)
          if (const Label label = anatomy.at(i, j, k); label == 1 || label == 2)
            target[static_cast<std::size_t>(i + kFieldSize * (j + kFieldSize * k))] = label == 1 ? 2.F : 1.F;
    return target;
  }

  void limit(std::vector<float>& sizes, RunContext& ctx) const {
    limit_gradation({kFieldSize, kFieldSize, kFieldSize}, anatomy.linear(), 0.3, sizes, ctx);
  }
};

}  // namespace voxtet::test
