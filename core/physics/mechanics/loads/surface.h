// A part of a body's surface: the volume that it encloses, and what that means for pressures on it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "physics/fem/fixed_order.h"
#include "physics/mechanics/elements/nodes.h"
#include "types/surface_mesh.h"

namespace voxtet::mechanics {

/// Triangles with their nodes, 3 or, of quadratic elements, 6. Whatever is pushed by a pressure p behind the
/// surface, against its normals, feels the force -p add_area_vectors(), whose derivative is
/// -p add_area_tangent(). The integrals are exact.
class Surface {
 public:
  /// A triangle's corners, then the middles of its edges in the same order, which linear elements leave out.
  using Face = std::array<std::uint32_t, 6>;

  Surface() = default;
  Surface(std::vector<Face> faces, bool quadratic) : per_face_(quadratic ? 6 : 3), faces_(std::move(faces)) {}
  /// `faces` are triangles between points of the mesh that the nodes are of, with their normals to the
  /// outside of the body, as TetMesh has them.
  Surface(const Nodes& nodes, std::span<const Triangle> faces);

  /// The integral of x . n / 3: of a closed surface the volume in it. `x`, here and below: where the nodes
  /// are, three numbers each, as Nodes::places_after() gives them; mm.
  double volume_mm3(const Eigen::VectorXd& x) const;

  /// Adds `factor` times the integral of phi n for each node's function phi: of a closed surface the gradient
  /// of its volume by x. mm^2 times the unit of `factor`; three numbers a node.
  void add_area_vectors(const Eigen::VectorXd& x, double factor, Eigen::VectorXd& force) const;

  /// Adds the derivative of that by x to a matrix that couples the nodes of a face, as
  /// Body::empty_tangent() does. Symmetric, but for rounding, if the surface is closed.
  void add_area_tangent(const Eigen::VectorXd& x, double factor, fem::SparseMatrix& tangent) const;

  /// Adds the matrix of springs that hold the surface where it was undeformed: times u it is the force that
  /// stretches them. Stiffnesses are by undeformed area, along its normals and across them, kPa/mm. Such a
  /// matrix couples the nodes of a face, as Body::empty_tangent() does; it is symmetric, but for rounding.
  void add_springs(const Nodes& nodes, double normal_kpa_per_mm, double tangential_kpa_per_mm,
                   fem::SparseMatrix& matrix) const;

 private:
  std::size_t per_face_ = 3;
  std::vector<Face> faces_;
};

}  // namespace voxtet::mechanics
