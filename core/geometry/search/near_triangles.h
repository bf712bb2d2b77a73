// Triangles near many points at once.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "types/surface_mesh.h"

namespace voxtet {

/// Asks for a triangle of one kind: any that is no farther than the limit, or else the closest.
struct NearQuery {
  Eigen::Vector3d point;  ///< mm
  double limit_mm = 0;
  std::uint32_t kind = 0;
};

struct NearTriangle {
  static constexpr std::uint32_t kNone = 0xffffffffU;
  std::uint32_t triangle = kNone;  ///< kNone if there is none of the kind
  bool within = false;             ///< whether it is no farther than the limit
};

/// For each query the first triangle within its limit, or else the closest one, of equally close ones the
/// first. `kinds`: by triangle. Each triangle examines the points in the cubes around it, so that points that
/// lie densely along a surface cost little; trees answer the remaining queries.
std::vector<NearTriangle> near_triangles(std::span<const NearQuery> queries,
                                         const std::vector<Eigen::Vector3d>& corners,
                                         const std::vector<Triangle>& triangles,
                                         const std::vector<std::uint32_t>& kinds);

}  // namespace voxtet
