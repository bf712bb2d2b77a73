// Smooth pseudo-random roughness that is the same on every platform.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace voxtet {

/// Lattice value noise in [0, 1]: an integer hash of (seed, lattice point), blended by the quintic of
/// Perlin's "Improving Noise" (2002), so twice continuously differentiable. Lattice points stand at integers.
double value_noise(const Eigen::Vector3d& point, std::uint32_t seed);

}  // namespace voxtet
