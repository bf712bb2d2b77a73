// Rotation matrices from angles that agree to the last bit on every platform.
#pragma once

#include <Eigen/Core>

namespace voxtet {

/// Rotation about the fixed x, then y, then z axis (degrees): Rz * Ry * Rx. Entries are rounded to multiples
/// of 1e-12, since the last bits of sin and cos differ between math libraries; quarter turns are exact.
Eigen::Matrix3d rotation_from_degrees(const Eigen::Vector3d& angles_deg);

}  // namespace voxtet
