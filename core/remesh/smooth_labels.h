// Smoothed label indicators at voxel centres, and the labels that win there.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "remesh/label_field.h"
#include "types/label_volume.h"

namespace voxtet::remesh {

/// A label image without an affine; x fastest. The outermost `LabelField::kPad` layers are background.
struct LabelGrid {
  std::array<int, 3> size{};
  std::vector<Label> labels;
  std::size_t voxel_count() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }
};

/// Half of a symmetric integer kernel, centre first; the whole sums to 1024.
using HalfKernel = std::vector<std::int32_t>;

/// Truncated Gaussian of `sigma` voxels; {1024} for sigma close to 0.
HalfKernel gaussian_kernel(double sigma);

/// Separable Gaussian of the one-hot indicators. Integer arithmetic: exact, so equal on every platform.
VoxelWeights smooth_indicators(const LabelGrid& grid, const std::array<HalfKernel, 3>& kernels);

/// The winner at every voxel centre, with the input's topology (see LabelField). Raises weights where a voxel
/// is kept against the smoothed indicators.
std::vector<Label> settle_winners(const LabelGrid& grid, VoxelWeights& weights, FieldLedger& ledger);

/// Ids of 6-connected components of equal label, from 0 in the order of their first voxel; `sizes` counts
/// voxels.
std::vector<std::uint32_t> label_components(const std::array<int, 3>& size, const std::vector<Label>& labels,
                                            std::vector<std::uint32_t>& sizes);

}  // namespace voxtet::remesh
