#include "geometry/elements/tet_measures.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace voxtet {
namespace {

constexpr double kDegrees = 57.295779513082320877;

}  // namespace

double tet_volume_mm3(const TetCorners& p) {
  return (p[1] - p[0]).dot((p[2] - p[0]).cross(p[3] - p[0])) / 6;
}

double mean_edge_mm(const TetCorners& p) {
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j) sum += (p[i] - p[j]).norm();
  return sum / 6;
}

TetShape measure_tet(const TetCorners& p) {
  TetShape shape;
  shape.volume_mm3 = tet_volume_mm3(p);
  const double volume = std::abs(shape.volume_mm3);

  // Outward normals (for a positive tetrahedron) of the faces opposite to each corner, twice the area long.
  const std::array<Eigen::Vector3d, 4> normal{
      (p[2] - p[1]).cross(p[3] - p[1]), (p[3] - p[0]).cross(p[2] - p[0]), (p[1] - p[0]).cross(p[3] - p[0]),
      (p[2] - p[0]).cross(p[1] - p[0])};
  double surface = 0, squares = 0, longest = 0;
  for (const Eigen::Vector3d& n : normal) surface += 0.5 * n.norm();
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [a, b] = kEdgesOfTet[e];
    const auto [c, d] = kEdgesOfTet[5 - e];
    const double length = (p[static_cast<std::size_t>(b)] - p[static_cast<std::size_t>(a)]).norm();
    shape.edge_mm[e] = length;
    squares += length * length;
    longest = std::max(longest, length);
    // The faces that meet at edge ab are those opposite to c and d: |n_c x n_d| = 6 V |e|.
    const double sine = 6 * volume * length;
    const double cosine = -normal[static_cast<std::size_t>(c)].dot(normal[static_cast<std::size_t>(d)]);
    shape.dihedral_deg[e] = std::atan2(sine, cosine) * kDegrees;
  }
  if (shape.volume_mm3 <= 0 || surface <= 0) {
    shape.aspect_ratio = std::numeric_limits<double>::infinity();
    return shape;
  }
  const double inradius = 3 * volume / surface;
  const double x = shape.edge_mm[0] * shape.edge_mm[5], y = shape.edge_mm[1] * shape.edge_mm[4],
               z = shape.edge_mm[2] * shape.edge_mm[3];
  // Heron's product over the three products of opposite edges, in the order that loses least.
  const double product = (x + y + z) * (y + z - x) * (z + x - y) * (x + y - z);
  const double circumradius = std::sqrt(std::max(0.0, product)) / (24 * volume);
  shape.radius_ratio = circumradius > 0 ? 3 * inradius / circumradius : 0;
  const double cube_root = std::cbrt(3 * volume);
  shape.mean_ratio = 12 * cube_root * cube_root / squares;
  shape.aspect_ratio = longest / (2 * std::sqrt(6.0) * inradius);
  return shape;
}

}  // namespace voxtet
