#include "physics/fem/point_tets.h"

namespace voxtet::fem {

PointTets tets_of_points(const TetMesh& mesh) {
  PointTets of;
  of.begin.assign(mesh.points.size() + 1, 0);
  for (const Tet& tet : mesh.tets)
    for (const std::uint32_t point : tet) ++of.begin[point + 1];
  for (std::size_t i = 0; i < mesh.points.size(); ++i) of.begin[i + 1] += of.begin[i];
  of.tets.resize(of.begin.back());
  std::vector<std::size_t> next(of.begin.begin(), of.begin.end() - 1);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (const std::uint32_t point : mesh.tets[t]) of.tets[next[point]++] = static_cast<std::uint32_t>(t);
  return of;
}

}  // namespace voxtet::fem
