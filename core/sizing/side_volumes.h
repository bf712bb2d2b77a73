// Sizes from volumes other than the one that is meshed: painted masks and images of sizes.
#pragma once

#include <string>
#include <vector>

#include "sizing/build_sizing_field.h"

namespace voxtet {

/// Lowers the field to the mask's sizes. `name` is that of the recipe's entry. Errors: kUsage for a mask
/// without sizes, with two for one label, with one for a label that it does not hold or that is not positive,
/// and for one of which no voxel with a size lies on the grid.
Status lower_by_mask(const LabelVolume& mask, const MaskSize& rule, const std::string& name,
                     SizingField& field);

/// Lowers `sizes` (mm, one per grid point) to what the image says, interpolated trilinearly among its voxels
/// that have a length. Warnings: an image that asks for nothing at some labelled voxels of the volume, and
/// one that asks for less than edge_min_mm or more than edge_max_mm there. Errors: kBadInput for values that
/// are no sizes, and for an image that asks for nothing at any labelled voxel.
Status lower_by_image(const LabelVolume& volume, const ScalarVolume& image, const std::string& name,
                      const SizingParams& params, const SizingField& grid, std::vector<float>& sizes,
                      RunContext& ctx);

}  // namespace voxtet
