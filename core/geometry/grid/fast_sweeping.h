// Bounds how fast the target edge length may change from place to place.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "types/run_context.h"

namespace voxtet {

/// Lowers h (mm, x fastest, one value per grid point, +infinity allowed) to the largest field h* <= h with
/// h*(x) <= h*(y) + gradation * |x - y|. `linear` maps index steps to mm.
///
/// Result: |h*(a) - h*(b)| <= gradation * |a - b| * (1 + 1e-5) for all 26 neighbours of a grid point. A field
/// that already fulfils this is left as it is, to 1e-6. h* is never lower than the exact min_y h(y) +
/// gradation * |x - y|. It is exact along the axes; the largest error is that around a lone fine point, in
/// parts of the rise: 8 % beside it and 5 % beyond 12 voxels with equal spacings, 10 % and 6.5 % with 1.4 x
/// 1.4 x 2 mm, 15 % and 10 % with 1 x 1.5 x 3 mm.
///
/// Method: fast sweeping (Zhao, "A Fast Sweeping Method for Eikonal Equations", Math. Comp. 74, 2005) with
/// the Godunov update of |grad h| = gradation, taken together with the straight paths to the 26 neighbours:
/// Godunov alone is up to 32 % too steep from a lone point to its diagonal neighbour. Only rows whose
/// surroundings changed are visited again, until none is left. On sheared grids, where Godunov's update does
/// not hold, the straight paths alone are used (up to 27 % too steep on the sheared grid of the tests).
/// Returns false if the caller cancelled.
bool limit_gradation(const std::array<int, 3>& size, const Eigen::Matrix3d& linear, double gradation,
                     std::vector<float>& h_mm, const RunContext& ctx);

/// Whether the columns are orthogonal enough for methods that only know spacings.
bool has_orthogonal_axes(const Eigen::Matrix3d& linear);

}  // namespace voxtet
