// An elastic body: the forces that its nodes feel from its stress, and how they change with displacements.
// Bonet and Wood, "Nonlinear Continuum Mechanics for Finite Element Analysis" (2008), chapters 8 and 9.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/fem/fixed_order.h"
#include "physics/mechanics/elements/nodal_volumes.h"
#include "physics/mechanics/elements/node_matrix.h"
#include "physics/mechanics/elements/nodes.h"
#include "physics/mechanics/materials/material.h"
#include "types/result.h"

namespace voxtet::mechanics {

inline const char* const kMechanicsStage = "mechanics";

/// What a body is made of.
struct Muscle {
  std::vector<Material> materials{TransverselyIsotropic{}};
  std::vector<std::uint16_t> material;  ///< of each tetrahedron; empty: the first
  double bulk_kpa = 1000;               ///< resistance to a change of volume
  double viscosity_kpa_s = 0;           ///< resistance to the rate of strain
  /// Columns fibre, sheet, sheet normal, at each sample of Nodes, tetrahedron by tetrahedron. Empty: the
  /// axes.
  std::vector<Eigen::Matrix3d> frames;
};

/// How fast a body is strained, by the implicit Euler method: from `before` to what it is now, in a step
/// above 0.
struct StrainRate {
  const Eigen::VectorXd& before;  ///< displacements at the step's begin
  double step_s;
};

/// Displacements u and forces are vectors of three numbers a node, 3 i + d (mm; kPa mm^2 = mN). The samples
/// of Nodes are summed in their order, so that results are the same bytes on every platform.
class Body {
 public:
  /// Returns kUsage for a bulk modulus, viscosity or material out of range, kInternal for lists of the wrong
  /// length, and kBadInput, with its place, for a tetrahedron without a positive volume.
  static Result<Body> make(const TetMesh& mesh, Formulation formulation, Muscle muscle);

  const Nodes& nodes() const { return nodes_; }
  Eigen::Index unknowns() const { return 3 * static_cast<Eigen::Index>(nodes_.places().size()); }

  /// Zeros where a tangent may have entries. With average nodal pressure, nodes are coupled with the
  /// neighbours of their neighbours.
  fem::SparseMatrix empty_tangent() const { return empty_node_matrix(graph_); }

  /// The gradient of the energy by u: what holds the body in balance with loads. `tension_kpa`: the active
  /// stress along the fibre, one number for each tetrahedron, or none. `tangent`, when given, is one of
  /// empty_tangent(), to which the derivative of the force is added; symmetric but for rounding. `rate`: adds
  /// the viscous stress S = viscosity dE/dt of Arostica et al., Computer Methods in Applied Mechanics and
  /// Engineering 435 (2025); without it the body is at rest. Returns kMeshing, with its place in the
  /// undeformed mesh, for a tetrahedron that u inverts, and kInternal for lists of the wrong length.
  Status add_forces(const Eigen::VectorXd& u, std::span<const double> tension_kpa, Eigen::VectorXd& force,
                    fem::SparseMatrix* tangent, const StrainRate* rate = nullptr) const;

  /// The energy itself, kPa mm^3 = uJ. Without that of tension and viscosity. Returns kMeshing likewise.
  Result<double> energy(const Eigen::VectorXd& u) const;

 private:
  Body() = default;

  struct Sample;  ///< one place of integration, deformed

  /// Calls visit(samples) for each tetrahedron in order; an error for the first that is inverted.
  template <class Visit>
  Status for_tets(const Eigen::VectorXd& u, Visit&& visit) const;
  /// Of the material without its resistance to a change of volume.
  Response response_at(const Sample& sample) const;

  Nodes nodes_;
  Muscle muscle_;
  bool nodal_ = false;  ///< whether pressures are those of nodal_volumes_
  NodalVolumes nodal_volumes_;
  NodeGraph graph_;                    ///< of the tangent
  std::vector<std::uint32_t> places_;  ///< in graph_, of the pairs of each tetrahedron's nodes
};

}  // namespace voxtet::mechanics
