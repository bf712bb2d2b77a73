// Sparse matrices of three rows and columns a node: 3 i + d is component d of node i. Where nodes have a
// pressure too, it is 3 nodes + i.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/fem/fixed_order.h"

namespace voxtet::mechanics {

using NodeGroup = std::span<const std::uint32_t>;

/// Which nodes are coupled.
class NodeGraph {
 public:
  NodeGraph() = default;
  /// All nodes of a group with each other, and themselves.
  NodeGraph(std::size_t nodes, const std::vector<NodeGroup>& groups);

  std::size_t nodes() const { return begin_.size() - 1; }
  /// Those that a node is coupled with, in ascending order.
  NodeGroup of(std::size_t node) const {
    return NodeGroup(coupled_).subspan(begin_[node], begin_[node + 1] - begin_[node]);
  }
  /// Where of(node) begins in the row of all of these lists, and how long that is.
  std::size_t begin(std::size_t node) const { return begin_[node]; }
  std::size_t couplings() const { return coupled_.size(); }
  /// Appends which of of(a) b is, for all pairs (a, b) of nodes that are coupled with each other, a by a.
  void append_places(NodeGroup group, std::vector<std::uint32_t>& places) const;

 private:
  std::vector<std::size_t> begin_{0};
  std::vector<std::uint32_t> coupled_;
};

/// Zeros where nodes are coupled.
fem::SparseMatrix empty_node_matrix(const NodeGraph& graph, bool with_pressures);

/// Adds to the three rows of a node and the three columns of another one, which it is coupled with.
void add_block(std::uint32_t row, std::uint32_t column, const Eigen::Matrix3d& block,
               fem::SparseMatrix& matrix);

// The same where the place of each node among those that the other one is coupled with is known.

inline void add_block_at(std::uint32_t row, std::uint32_t place, const Eigen::Matrix3d& block,
                         fem::SparseMatrix& matrix) {
  const int* const begin = matrix.outerIndexPtr() + 3 * static_cast<std::ptrdiff_t>(row);
  for (int i = 0; i < 3; ++i) {
    double* const values = matrix.valuePtr() + begin[i] + 3 * static_cast<std::ptrdiff_t>(place);
    for (int j = 0; j < 3; ++j) values[j] += block(i, j);
  }
}

/// Adds to the row of a node's pressure and the column of another one's.
inline void add_pressure_at(std::uint32_t row, std::uint32_t place, double value, fem::SparseMatrix& matrix) {
  const int* const begin = matrix.outerIndexPtr() + 3 * (matrix.rows() / 4) + row;
  matrix.valuePtr()[begin[0] + (begin[1] - begin[0]) / 4 * 3 + static_cast<int>(place)] += value;
}

/// Adds to the three rows of a node and the column of another one's pressure, and the other way round.
inline void add_gradient_at(std::uint32_t node, std::uint32_t place_of_pressure, std::uint32_t pressure,
                            std::uint32_t place_of_node, const Eigen::Vector3d& gradient,
                            fem::SparseMatrix& matrix) {
  const int* const begin = matrix.outerIndexPtr() + 3 * static_cast<std::ptrdiff_t>(node);
  double* const across =
      matrix.valuePtr() + matrix.outerIndexPtr()[3 * (matrix.rows() / 4) + pressure] + 3 * place_of_node;
  for (int i = 0; i < 3; ++i) {
    matrix.valuePtr()[begin[i] + (begin[i + 1] - begin[i]) / 4 * 3 + static_cast<int>(place_of_pressure)] +=
        gradient[i];
    across[i] += gradient[i];
  }
}

}  // namespace voxtet::mechanics
