// Restores the volumes of a smoothed complex by shifting interfaces along their normals.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/repair/retreat.h"
#include "surface/smooth/crossing_limits.h"
#include "surface/smooth/move_limits.h"
#include "surface/smooth/surface_graph.h"
#include "types/run_context.h"
#include "types/surface_mesh.h"

namespace voxtet {

/// Regions behind and in front of each triangle (those of its sides).
using RegionSides = std::vector<std::array<std::uint32_t, 2>>;

/// What stays the same from one correction of a surface to the next. References must stay valid.
struct CorrectionProblem {
  const SurfaceMesh& surface;                 ///< for its triangles
  const RegionSides& regions;                 ///< by triangle
  const std::vector<double>& target;          ///< wanted volume by region, in voxels
  const std::vector<Eigen::Vector3d>& start;  ///< index space
  const MoveLimits& limits;
  double orientation = 1;  ///< sign of the affine's determinant
};

/// The interface of regions a and b moves by delta_ab = lambda_a - lambda_b (lambda of the outside is 0). Of
/// all solutions of: sum over neighbours b of area_ab * delta_ab = missing volume of a, this is the one with
/// the least area-weighted sum of squares. Only points with `movable` not 0 move, along their normal and
/// within their limits around their start and their crossings. A point that the limits stop takes no further
/// part: its flag becomes 0. At most eight rounds, fewer once every region has its volume to a ten-thousandth
/// and a hundredth of a voxel. `points` are in index space. False when cancelled.
bool correct_volumes(const CorrectionProblem& problem, const std::vector<CrossingLimit>& crossings,
                     const RunContext& ctx, Flags& movable, std::vector<Eigen::Vector3d>& points);

}  // namespace voxtet
