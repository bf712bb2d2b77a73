// The volumes around nodes, by which average nodal pressure knows how much a body is compressed: Bonet and
// Burton, Communications in Numerical Methods in Engineering 14 (1998).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "physics/mechanics/elements/node_matrix.h"
#include "physics/mechanics/elements/nodes.h"
#include "physics/mechanics/materials/material.h"

namespace voxtet::mechanics {

/// Each linear tetrahedron gives a quarter of its volume to each of its nodes. The energy is the sum of a
/// node's undeformed volume times U(its volume now / its undeformed volume).
class NodalVolumes {
 public:
  NodalVolumes() = default;
  /// `around`: couples the nodes of a tetrahedron.
  NodalVolumes(const Nodes& nodes, NodeGraph around);

  /// Couples the nodes around each node: what the tangent needs.
  NodeGraph coupled() const;
  /// Finds its blocks in matrices of coupled().
  void find_blocks(const NodeGraph& coupled);

  /// U, U' and U'' of each node.
  std::vector<Volumetric> at_nodes(const Nodes& nodes, const Eigen::VectorXd& u, double bulk_kpa) const;
  double energy(const std::vector<Volumetric>& at_nodes) const;
  /// Adds that part of the tangent in which the pressures of nodes change.
  void add_tangent(const Nodes& nodes, const Eigen::VectorXd& u, const std::vector<Volumetric>& at_nodes,
                   fem::SparseMatrix& tangent) const;

 private:
  std::vector<double> volumes(const Nodes& nodes, const Eigen::VectorXd& u) const;

  NodeGraph around_;
  std::vector<std::uint32_t> places_;  ///< in around_, of the pairs of each tetrahedron's nodes
  std::vector<std::uint32_t> blocks_;  ///< in coupled(), of the pairs of each node's around_
  std::vector<double> undeformed_;     ///< mm^3
};

}  // namespace voxtet::mechanics
