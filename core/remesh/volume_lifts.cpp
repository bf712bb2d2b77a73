#include "remesh/volume_lifts.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "geometry/surface_measures.h"

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

std::vector<double> volume_lifts(const std::vector<Sides>& pairs, const std::vector<double>& areas_mm2,
                                 const std::vector<double>& lacking_mm3, double most_mm) {
  constexpr int kSweeps = 200;  // of damped Jacobi; the system is the graph Laplacian of the labels
  const std::size_t count = lacking_mm3.size();
  std::vector<double> lifts(pairs.size(), 0), lambda(count, 0), sums(count), weights(count);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t l = 0; l < sums.size(); ++l) {
      sums[l] = lacking_mm3[l];
      weights[l] = 0;
    }
    for (std::size_t pair = 0; pair < pairs.size(); ++pair)
      for (const std::size_t end : {0, 1}) {
        sums[pairs[pair][end]] += areas_mm2[pair] * lambda[pairs[pair][1 - end]];
        weights[pairs[pair][end]] += areas_mm2[pair];
      }
    for (std::size_t l = 1; l < lambda.size(); ++l)
      if (weights[l] > 0) lambda[l] = 0.5 * (lambda[l] + sums[l] / weights[l]);
  }
  for (std::size_t pair = 0; pair < pairs.size(); ++pair)
    lifts[pair] = std::clamp(lambda[pairs[pair][0]] - lambda[pairs[pair][1]], -most_mm, most_mm);
  return lifts;
}

}  // namespace voxtet::remesh
