// A linear tetrahedron.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <vector>

#include "types/tet_mesh.h"

namespace voxtet::fem {

/// A tetrahedron's volume in mm^3 and the constant gradients of its four functions in 1/mm.
struct Element {
  double volume = 0;
  std::array<Eigen::Vector3d, 4> gradient;
};

inline Element element_of(const std::vector<Eigen::Vector3d>& points, const Tet& tet) {
  const Eigen::Vector3d& p = points[tet[0]];
  const Eigen::Vector3d a = points[tet[1]] - p, b = points[tet[2]] - p, c = points[tet[3]] - p;
  const Eigen::Vector3d across_a = b.cross(c), across_b = c.cross(a), across_c = a.cross(b);
  const double six_volumes = a.dot(across_a);
  Element element;
  element.volume = six_volumes / 6;
  element.gradient[1] = across_a / six_volumes;
  element.gradient[2] = across_b / six_volumes;
  element.gradient[3] = across_c / six_volumes;
  element.gradient[0] = -(element.gradient[1] + element.gradient[2] + element.gradient[3]);
  return element;
}

inline Element element_of(const TetMesh& mesh, std::size_t t) {
  return element_of(mesh.points, mesh.tets[t]);
}

}  // namespace voxtet::fem
