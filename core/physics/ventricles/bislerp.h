// Interpolation between two frames of directions whose signs mean nothing.
// Bayer et al., Annals of Biomedical Engineering 40 (2012), supplement, function 4; Shoemake, "Animating
// rotation with quaternion curves", SIGGRAPH (1985): slerp.
#pragma once

#include <Eigen/Core>

namespace voxtet {

/// The frame at `t`, 0 to 1, on the shortest turn from `a` to `b` at even speed. Columns are right-handed and
/// orthonormal. `a` is first turned by half a turn about one of its own columns, where that brings it nearer
/// to `b`: which changes the signs of the other two columns. Exactly `b` at 1, up to rounding; at 0 `a` up to
/// those signs. The same bytes on every platform.
Eigen::Matrix3d bislerp(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, double t);

}  // namespace voxtet
