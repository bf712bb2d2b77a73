#include "geometry/grid/rasterise.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/elements/tet_measures.h"

namespace voxtet {
namespace {

/// Integer range of the coordinates d of four points, cut to [0, size).
std::pair<int, int> range_of(const TetCorners& p, int d, int size) {
  if (!p[0].allFinite() || !p[1].allFinite() || !p[2].allFinite() || !p[3].allFinite()) return {0, -1};
  const double low = std::min({p[0][d], p[1][d], p[2][d], p[3][d]});
  const double high = std::max({p[0][d], p[1][d], p[2][d], p[3][d]});
  return {static_cast<int>(std::ceil(std::clamp(low, 0.0, static_cast<double>(size)))),
          static_cast<int>(std::floor(std::clamp(high, -1.0, static_cast<double>(size - 1))))};
}

}  // namespace

std::vector<Label> rasterise(const TetMesh& mesh, std::span<const Label> labels, const LabelVolume& grid) {
  const Eigen::Matrix3d to_index = grid.linear().inverse();
  const Eigen::Vector3d origin = grid.origin();
  std::vector<Eigen::Vector3d> index;
  index.reserve(mesh.points.size());
  for (const Eigen::Vector3d& p : mesh.points) index.emplace_back(to_index * (p - origin));

  std::vector<Label> out(grid.voxel_count(), kBackground);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto [a, b, c, d] = mesh.tets[t];
    const TetCorners p{index[a], index[b], index[c], index[d]};
    Eigen::Matrix3d edges;
    edges << p[1] - p[0], p[2] - p[0], p[3] - p[0];
    const Eigen::Matrix3d to_local = edges.inverse();
    const auto [k0, k1] = range_of(p, 2, grid.size[2]);
    const auto [j0, j1] = range_of(p, 1, grid.size[1]);
    const auto [i0, i1] = range_of(p, 0, grid.size[0]);
    for (int k = k0; k <= k1; ++k)
      for (int j = j0; j <= j1; ++j)
        for (int i = i0; i <= i1; ++i) {
          const Eigen::Vector3d local = to_local * (Eigen::Vector3d(i, j, k) - p[0]);
          constexpr double slack = -1e-9;
          // Asked this way round, a flat tetrahedron (not a number) holds no centre.
          if (!(local.x() >= slack && local.y() >= slack && local.z() >= slack && local.sum() <= 1 - slack))
            continue;
          Label& label = out[grid.offset(i, j, k)];
          if (label == kBackground) label = labels[t];
        }
  }
  return out;
}

}  // namespace voxtet
