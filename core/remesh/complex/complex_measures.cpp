#include "remesh/complex/complex_measures.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "geometry/elements/surface_measures.h"

namespace voxtet::remesh {

std::vector<double> label_volumes(const ComplexMesh& mesh) {
  Label largest = 0;
  for (const Sides& s : mesh.sides()) largest = std::max(largest, s[0]);
  std::vector<double> volumes(std::size_t{largest} + 1, 0);
  const Eigen::Vector3d origin = mesh.point(0);
  for (std::uint32_t t = 0; t < mesh.slot_count(); ++t) {
    if (!mesh.alive(t)) continue;
    const Corners p = mesh.corners(mesh.triangle(t));
    const double volume = (p[0] - origin).dot(triangle_cross(p[0], p[1], p[2])) / 6;
    volumes[mesh.sides()[mesh.pair(t)][0]] += volume;
    volumes[mesh.sides()[mesh.pair(t)][1]] -= volume;
  }
  return volumes;
}

std::vector<double> pair_areas(const ComplexMesh& mesh) {
  std::vector<double> areas(mesh.sides().size(), 0);
  for (std::uint32_t t = 0; t < mesh.slot_count(); ++t) {
    if (!mesh.alive(t)) continue;
    const Corners p = mesh.corners(mesh.triangle(t));
    areas[mesh.pair(t)] += triangle_area_mm2(p[0], p[1], p[2]);
  }
  return areas;
}

}  // namespace voxtet::remesh
