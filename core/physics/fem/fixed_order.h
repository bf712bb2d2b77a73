// Sparse matrices, and their products in one fixed order of summation, so that results are the same bytes on
// every platform.
#pragma once

#include <Eigen/SparseCore>

namespace voxtet::fem {

/// Square and compressed, a row and a column for each point of the mesh; columns ascend within a row.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// y = A x, each row summed in the order of its columns. `y` takes the size of `x`; it may not be `x`.
void multiply(const SparseMatrix& a, const Eigen::VectorXd& x, Eigen::VectorXd& y);

/// The sum of x_i y_i, in the order of i. Vectors of the same size.
double dot(const Eigen::VectorXd& x, const Eigen::VectorXd& y);

}  // namespace voxtet::fem
