// What one tetrahedron adds to the forces and the tangent of a body.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "physics/mechanics/elements/nodes.h"
#include "physics/mechanics/materials/material.h"

namespace voxtet::mechanics {

/// How area vectors are deformed: det F times the inverse transpose of F.
Eigen::Matrix3d cofactor(const Eigen::Matrix3d& f);

/// A sum over places of integration.
class ElementForces {
 public:
  /// Zeros, of so many nodes, at most 10.
  ElementForces(std::size_t nodes, bool with_tangent);

  /// Adds a place of this weight, mm^3, where F is the deformation gradient.
  void add(double weight, const Eigen::Matrix3d& f, const Response& response, const Shape* shapes);

  const Eigen::Vector3d& force(std::size_t a) const { return force_[a]; }
  /// The derivative of the force on a by the place of b, a <= b; that of b by a is its transpose.
  const Eigen::Matrix3d& tangent(std::size_t a, std::size_t b) const { return tangent_[10 * a + b]; }

 private:
  std::size_t nodes_;
  bool with_tangent_;
  std::array<Eigen::Vector3d, 10> force_;
  std::array<Eigen::Matrix3d, 100> tangent_;
};

}  // namespace voxtet::mechanics
