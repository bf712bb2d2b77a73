// Sparse matrices of three rows and columns a node: 3 i + d is component d of node i.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "physics/fem/fixed_order.h"

namespace voxtet::mechanics {

/// Zeros where `neighbours` couples two nodes: of each node the nodes, itself among them, in ascending order.
fem::SparseMatrix empty_node_matrix(const std::vector<std::vector<std::uint32_t>>& neighbours);

/// Adds to the three rows of a node and the three columns of another one, which it is coupled with.
void add_block(std::uint32_t row, std::uint32_t column, const Eigen::Matrix3d& block,
               fem::SparseMatrix& matrix);

}  // namespace voxtet::mechanics
