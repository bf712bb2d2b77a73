// Checks every edit of a complex a second time, with another search and other predicates than the editor.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "remesh/complex/complex_mesh.h"

namespace voxtet::remesh {

/// Stores where every triangle has been, in columns along z. It forgets none, so that triangles that come
/// back are found again; the complex tells which are still there.
class IntersectionVerifier {
 public:
  explicit IntersectionVerifier(const ComplexMesh& mesh);

  /// Number of pairs of triangles, at least one of them in `triangles`, that meet beyond their common
  /// corners. Exact.
  std::size_t intersections_around(const ComplexMesh& mesh, const std::vector<std::uint32_t>& triangles);

 private:
  void list(const ComplexMesh& mesh, std::uint32_t t);
  template <class Visit>
  void for_columns(const Eigen::AlignedBox3d& box, Visit&& visit);

  Eigen::Vector3d low_;
  double per_mm_;  ///< columns per mm
  std::vector<std::vector<std::uint32_t>> columns_;
};

}  // namespace voxtet::remesh
