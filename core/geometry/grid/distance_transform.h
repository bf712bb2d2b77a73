// Exact Euclidean distance from every voxel to a set of voxels.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace voxtet {

/// The distance if the mask is empty.
inline constexpr float kFar = std::numeric_limits<float>::infinity();

/// Distance (mm) from each voxel centre to the nearest voxel centre whose mask value is not 0; 0 on the mask
/// itself, kFar everywhere if the mask is empty. `mask` holds size[0]*size[1]*size[2] values, x fastest;
/// `spacing_mm` is the distance between centres along each axis, and the axes are orthogonal. Linear time.
/// Lower envelope of parabolas: Felzenszwalb and Huttenlocher, "Distance Transforms of Sampled Functions",
/// Theory of Computing 8 (2012).
std::vector<float> distance_to_mask_mm(const std::array<int, 3>& size, const Eigen::Vector3d& spacing_mm,
                                       std::span<const std::uint8_t> mask);

}  // namespace voxtet
