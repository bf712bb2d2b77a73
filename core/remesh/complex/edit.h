// One local edit of a complex, described before it is tried.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "remesh/complex/complex_mesh.h"

namespace voxtet::remesh {

using CurveEdge = std::array<std::uint32_t, 2>;

/// Removed triangles are replaced by facets that cover the same part of the surface; facet i lies about where
/// triangle i was. Vectors keep their memory from edit to edit.
struct Edit {
  std::vector<std::uint32_t> removed;
  std::vector<Facet> added;
  std::vector<CurveEdge> curves_removed, curves_added;
  std::uint32_t moved = kNone;  ///< a vertex that gets another position, if any
  Eigen::Vector3d position = Eigen::Vector3d::Zero();

  void clear() {
    removed.clear();
    added.clear();
    curves_removed.clear();
    curves_added.clear();
    moved = kNone;
  }
};

/// Where the corners of a facet that the edit adds will be.
inline Corners corners_after(const ComplexMesh& mesh, const Edit& edit, const Facet& facet) {
  Corners corners = mesh.corners(facet.corners);
  for (std::size_t i = 0; i < 3; ++i)
    if (facet.corners[i] == edit.moved) corners[i] = edit.position;
  return corners;
}

/// Why an edit was refused, in the order of the checks.
enum class Refusal : std::uint8_t {
  kNo,  ///< accepted
  kLink,
  kLength,
  kAngle,
  kCurve,
  kNormal,
  kEnvelope,
  kReverse,
  kIntersection,
  kDihedral,
  kGap,
  kNotDelaunay,
};
inline constexpr std::size_t kRefusalCount = static_cast<std::size_t>(Refusal::kNotDelaunay) + 1;

}  // namespace voxtet::remesh
