// An elastic body: the forces that its nodes feel from its stress, and how they change with displacements.
// Bonet and Wood, "Nonlinear Continuum Mechanics for Finite Element Analysis" (2008), chapters 8 and 9.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/fem/fixed_order.h"
#include "physics/mechanics/elements/linear_pressure.h"
#include "physics/mechanics/elements/node_matrix.h"
#include "physics/mechanics/elements/nodes.h"
#include "physics/mechanics/materials/material.h"
#include "types/result.h"
#include "types/stage_names.h"

namespace voxtet::mechanics {

/// What a body is made of.
struct Muscle {
  std::vector<Material> materials{TransverselyIsotropic{}};
  std::vector<std::uint16_t> material;  ///< of each tetrahedron; empty: the first
  double bulk_kpa = 1000;               ///< resistance to a change of volume
  double viscosity_kpa_s = 0;           ///< resistance to the rate of strain
  /// Columns fibre, sheet, sheet normal, at each sample of Nodes, tetrahedron by tetrahedron: four of each of
  /// them, or of linear elements one. Empty: the axes.
  std::vector<Eigen::Matrix3d> frames;
};

/// How fast a body is strained, by the implicit Euler method: from `before` to what it is now, in a step
/// above 0.
struct StrainRate {
  const Eigen::VectorXd& before;  ///< displacements at the step's begin
  double step_s;
};

/// Displacements u and forces are vectors of three numbers a node, 3 i + d (mm; kPa mm^2 = mN). With average
/// nodal pressure and with kStabilised there follow the pressures of all nodes, p (kPa), and as their forces
/// volumes (mm^3): the energy is then W and that of LinearPressure. In balance it is least among
/// displacements, and most among pressures. The samples of Nodes are summed in their order, so that results
/// are the same bytes on every platform.
class Body {
 public:
  /// Returns kUsage for a bulk modulus, viscosity or material out of range (with kStabilised also for one
  /// that does not resist shear), kInternal for lists of the wrong length, and kBadInput, with its place, for
  /// a tetrahedron without a positive volume.
  static Result<Body> make(const TetMesh& mesh, Formulation formulation, Muscle muscle);

  const Nodes& nodes() const { return nodes_; }
  Eigen::Index displacements() const { return 3 * static_cast<Eigen::Index>(nodes_.places().size()); }
  /// Displacements, and pressures where they are unknown.
  Eigen::Index unknowns() const { return displacements() + (has_pressures() ? displacements() / 3 : 0); }

  /// Zeros where a tangent may have entries.
  fem::SparseMatrix empty_tangent() const { return empty_node_matrix(graph_, has_pressures()); }

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

  /// The pressures among the unknowns, kPa; none where there are none.
  Eigen::VectorXd node_pressures_kpa(const Eigen::VectorXd& u) const {
    return u.tail(unknowns() - displacements());
  }

 private:
  Body() = default;
  bool stabilised() const { return formulation_ == Formulation::kStabilised; }
  bool has_pressures() const { return stabilised() || formulation_ == Formulation::kAverageNodalPressure; }

  struct Sample;  ///< one place of integration, deformed

  /// Calls visit(samples) for each tetrahedron in order; an error for the first that is inverted.
  template <class Visit>
  Status for_tets(const Eigen::VectorXd& u, Visit&& visit) const;
  std::size_t material_of(std::size_t t) const { return muscle_.material.empty() ? 0 : muscle_.material[t]; }
  /// Of the material without its resistance to a change of volume.
  Response response_at(const Sample& sample) const;
  LinearPressure pressure_of(std::size_t t, const Eigen::VectorXd& u) const;
  /// Adds the rows and columns of the pressures of a tetrahedron.
  void add_pressures(const Sample& sample, const LinearPressure& pressure, Eigen::VectorXd& force,
                     fem::SparseMatrix* tangent) const;

  Nodes nodes_;
  Muscle muscle_;
  std::vector<double> shear_kpa_;  ///< of each material, what stabilises pressures
  Formulation formulation_ = Formulation::kLinear;
  NodeGraph graph_;                    ///< of the tangent
  std::vector<std::uint32_t> places_;  ///< in graph_, of the pairs of each tetrahedron's nodes
};

}  // namespace voxtet::mechanics
