// The curvature of the label surface -> edge lengths near it.
#pragma once

#include <vector>

#include "sizing/build_sizing_field.h"

namespace voxtet {

/// Lowers the field to what the rules ask, at the grid points next to the smoothed label surface: by the
/// mean of the curvatures at its points around each.
void lower_by_curvature(const SurfaceMesh& surface, const std::vector<CurvatureSize>& rules, double voxel_mm,
                        SizingField& field);

}  // namespace voxtet
