// How far the surface may move before it passes a voxel's centre.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "types/surface_mesh.h"

namespace voxtet {

/// The vertex moves at most `reach` along `normal`, both ways; without a normal it is free.
struct CrossingLimit {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double reach = 0;

  /// The nearest move that the limit allows.
  Eigen::Vector3d clamped(const Eigen::Vector3d& move) const {
    const double along = normal.dot(move);
    return move - (along - std::clamp(along, -reach, reach)) * normal;
  }
};

/// A vertex began in the middle of a lattice edge e between two voxels' centres. While it moves by at most
/// |n.e|/2 along the surface's normal n, its tangent plane crosses that edge between the two, as the boundary
/// of the body does: so the limits ask of a surface what its voxels say, and no more. Vertices that began
/// elsewhere are free. Where vertices may move by more than half a voxel along an axis, `reach`, the plane
/// may move so much further.
///
/// `start`: vertices of an extracted surface in index space, exact to a small fraction of a voxel. Normals
/// are those of `points`, averaged over triangles by area: a surface that has lost the worst of its
/// staircase.
std::vector<CrossingLimit> crossing_limits(const std::vector<Triangle>& triangles,
                                           const std::vector<Eigen::Vector3d>& start,
                                           const std::vector<Eigen::Vector3d>& points,
                                           const Eigen::Vector3d& reach);

}  // namespace voxtet
