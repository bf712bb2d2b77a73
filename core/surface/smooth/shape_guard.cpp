#include "surface/smooth/shape_guard.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "base/parallel.h"
#include "surface/smooth/voxel_centres.h"

namespace voxtet {
namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr double kSmallestAreaRatio = 0.02;

bool keeps_area(const Points& start, const Points& points, const Triangle& t) {
  const auto cross = [&t](const Points& at) -> Eigen::Vector3d {
    return (at[t[1]] - at[t[0]]).cross(at[t[2]] - at[t[0]]);
  };
  const Eigen::Vector3d before = cross(start);
  return cross(points).dot(before) >= kSmallestAreaRatio * before.squaredNorm();
}

bool is_held(const VoxelRegions& regions, const Eigen::Vector3d& centre) {
  const auto [others, thin_axes] = regions.around(static_cast<int>(centre.x()), static_cast<int>(centre.y()),
                                                  static_cast<int>(centre.z()));
  return others == 0 || thin_axes > 0;
}

bool passes_held_centre(const VoxelRegions& regions, const Points& start, const Points& points,
                        const Triangle& t) {
  const std::array<const Eigen::Vector3d*, 6> hull{&start[t[0]],  &start[t[1]],  &start[t[2]],
                                                   &points[t[0]], &points[t[1]], &points[t[2]]};
  return reaches_centre(hull, [&](const Eigen::Vector3d& centre) { return is_held(regions, centre); });
}

}  // namespace

Flags guard_shape(const std::vector<Triangle>& triangles, const VoxelRegions& regions, const Points& start,
                  const Points& safe, Points& points, const RunContext& ctx) {
  Retreat retreat(triangles, safe, points, ctx.threads);
  Flags flagged = retreat.displaced();
  for (bool any = true; any;) {
    parallel_for(ctx.threads, triangles.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t t = first; t < last; ++t)
        flagged[t] = flagged[t] && (!keeps_area(start, points, triangles[t]) ||
                                    passes_held_centre(regions, start, points, triangles[t]));
    });
    any = std::find(flagged.begin(), flagged.end(), std::uint8_t{1}) != flagged.end();
    if (any) retreat.step(flagged);
  }
  Flags back(points.size());
  for (std::size_t v = 0; v < back.size(); ++v) back[v] = retreat.went_back(v);
  return back;
}

}  // namespace voxtet
