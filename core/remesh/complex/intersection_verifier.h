// A second opinion on every edit of a complex: another search and other predicates than those of the
// editor.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "remesh/complex/complex_mesh.h"

namespace voxtet::remesh {

/// Knows where every triangle has been, in columns along z. It forgets none, so that what is taken back is
/// found again; what is no longer there is told by the complex.
class IntersectionVerifier {
 public:
  explicit IntersectionVerifier(const ComplexMesh& mesh);

  /// Pairs of triangles that meet beyond their common corners, exact, among all around these new ones.
  std::size_t intersections_around(const ComplexMesh& mesh, const std::vector<std::uint32_t>& triangles);

 private:
  void list(const ComplexMesh& mesh, std::uint32_t t);
  template <class Visit>
  void for_columns(const Eigen::AlignedBox3d& box, Visit&& visit);

  Eigen::Vector3d low_;
  double per_mm_;  ///< columns
  std::vector<std::vector<std::uint32_t>> columns_;
};

}  // namespace voxtet::remesh
