// The curvature of the label surface -> edge lengths near it.
#pragma once

#include <vector>

#include "sizing/build_sizing_field.h"

namespace voxtet {

/// Lowers the field, at the grid points next to the smoothed label surface, to the lengths that the rules ask
/// for there. The curvature at a grid point is the mean over the surface's points around it.
void lower_by_curvature(const SurfaceMesh& surface, const std::vector<CurvatureSize>& rules, double voxel_mm,
                        SizingField& field);

}  // namespace voxtet
