// Surfaces of label volumes, extracted with either method.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <utility>

#include "surface/extract/extract_surface.h"

namespace voxtet::test {

inline constexpr std::array<ExtractMethod, 2> kBothMethods{ExtractMethod::kMarchingCubes,
                                                           ExtractMethod::kMarchingTets};

inline SurfaceMesh extract(const LabelVolume& volume, ExtractMethod method = ExtractMethod::kAuto) {
  RunContext ctx;
  ExtractParams params;
  params.method = method;
  Result<SurfaceMesh> result = extract_surface(volume, params, ctx);
  if (!result) {
    ADD_FAILURE() << result.error().message;
    return {};
  }
  return std::move(result).value();
}

}  // namespace voxtet::test
