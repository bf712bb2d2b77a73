// Tissue that is the same everywhere, to be changed where a test wants something else.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>

#include "types/tet_mesh.h"
#include "types/tissue.h"

namespace voxtet::test {

/// One kind of tissue, all fibres in one direction.
inline Tissue uniform_tissue(const TetMesh& mesh, double along, double across, const Eigen::Vector3d& fibre) {
  Tissue tissue;
  tissue.kinds = {{along, across, {}}};
  tissue.kind.assign(mesh.tets.size(), 0);
  tissue.fibre.assign(mesh.tets.size(), fibre);
  return tissue;
}

/// The same in all directions, without fibres.
inline Tissue isotropic_tissue(const TetMesh& mesh, double speed) {
  Tissue tissue = uniform_tissue(mesh, speed, speed, Eigen::Vector3d::UnitX());
  tissue.fibre.clear();
  return tissue;
}

inline std::uint32_t nearest_point(const TetMesh& mesh, const Eigen::Vector3d& to) {
  const auto distance = [&](const Eigen::Vector3d& p) { return (p - to).squaredNorm(); };
  const auto nearest =
      std::min_element(mesh.points.begin(), mesh.points.end(),
                       [&](const auto& p, const auto& q) { return distance(p) < distance(q); });
  return static_cast<std::uint32_t>(nearest - mesh.points.begin());
}

inline Eigen::Vector3d centroid(const TetMesh& mesh, const Tet& tet) {
  return (mesh.points[tet[0]] + mesh.points[tet[1]] + mesh.points[tet[2]] + mesh.points[tet[3]]) / 4;
}

}  // namespace voxtet::test
