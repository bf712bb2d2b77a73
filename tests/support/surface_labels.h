// Which label a surface gives each voxel centre, compared with the volume it was made from.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "types/label_volume.h"
#include "types/surface_mesh.h"

namespace voxtet::test {

struct ChangedVoxels {
  std::size_t all = 0;    ///< voxel centres that the surface gives another label
  std::size_t inner = 0;  ///< those whose 6 neighbours have the voxel's own label: deeper than half a voxel
  std::size_t thin = 0;   ///< those with other labels on both sides along some axis
};

/// Casts a ray along x through every row of voxel centres (moved aside by a hundred-thousandth of a voxel, so
/// that it misses vertices) and follows the sides of the triangles it crosses.
inline ChangedVoxels changed_voxels(const SurfaceMesh& surface, const LabelVolume& volume) {
  struct Crossing {
    double x;
    int label, change;  ///< the label is entered (+1) or left (-1) on the way along x
  };
  constexpr double kAsideY = 1.37e-5, kAsideZ = 2.11e-5;
  const auto rows = static_cast<std::size_t>(volume.size[1]) * static_cast<std::size_t>(volume.size[2]);
  std::vector<std::vector<Crossing>> crossings(rows);
  const Eigen::Matrix3d to_index = volume.linear().inverse();
  const double turn = volume.linear().determinant() < 0 ? -1 : 1;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    std::array<Eigen::Vector3d, 3> p;
    for (std::size_t i = 0; i < 3; ++i)
      p[i] = to_index * (surface.points[surface.triangles[t][i]] - volume.origin()) -
             Eigen::Vector3d(0, kAsideY, kAsideZ);
    const auto [y0, y1] = std::minmax({p[0].y(), p[1].y(), p[2].y()});
    const auto [z0, z1] = std::minmax({p[0].z(), p[1].z(), p[2].z()});
    const double area =
        (p[1].y() - p[0].y()) * (p[2].z() - p[0].z()) - (p[1].z() - p[0].z()) * (p[2].y() - p[0].y());
    if (area == 0) continue;
    for (int k = std::max(0, static_cast<int>(std::ceil(z0))); k <= z1 && k < volume.size[2]; ++k)
      for (int j = std::max(0, static_cast<int>(std::ceil(y0))); j <= y1 && j < volume.size[1]; ++j) {
        double x = 0;
        bool inside = true;
        for (std::size_t i = 0; i < 3; ++i) {
          const Eigen::Vector3d &a = p[(i + 1) % 3], &b = p[(i + 2) % 3];
          const double part = ((a.y() - j) * (b.z() - k) - (a.z() - k) * (b.y() - j)) / area;
          inside = inside && part >= 0;
          x += part * p[i].x();
        }
        if (!inside) continue;
        // A normal along +x means that the ray leaves sides[0] and enters sides[1].
        const int leaves = area * turn > 0 ? 0 : 1;
        auto& row = crossings[static_cast<std::size_t>(j + volume.size[1] * k)];
        row.push_back({x, surface.sides[t][static_cast<std::size_t>(leaves)], -1});
        row.push_back({x, surface.sides[t][static_cast<std::size_t>(1 - leaves)], 1});
      }
  }
  ChangedVoxels out;
  std::vector<int> depth(65536, 0);
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j) {
      auto& row = crossings[static_cast<std::size_t>(j + volume.size[1] * k)];
      std::stable_sort(row.begin(), row.end(),
                       [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
      std::fill(depth.begin(), depth.end(), 0);
      depth[kBackground] = 1;
      std::size_t next = 0;
      for (int i = 0; i < volume.size[0]; ++i) {
        for (; next < row.size() && row[next].x < i; ++next)
          depth[static_cast<std::size_t>(row[next].label)] += row[next].change;
        const Label label = volume.at(i, j, k);
        if (depth[label] == 1) continue;
        ++out.all;
        int others = 0;
        bool thin = false;
        for (const std::array<int, 3>& axis :
             {std::array{1, 0, 0}, std::array{0, 1, 0}, std::array{0, 0, 1}}) {
          int along = 0;
          for (const int step : {-1, 1})
            along +=
                volume.at_or_background(i + step * axis[0], j + step * axis[1], k + step * axis[2]) != label;
          others += along;
          thin = thin || along == 2;
        }
        out.inner += others == 0 ? 1 : 0;
        out.thin += thin ? 1 : 0;
      }
    }
  return out;
}

}  // namespace voxtet::test
