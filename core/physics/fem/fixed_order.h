// Sparse matrices, and their products in one fixed order of summation, so that results are the same bytes on
// every platform.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

namespace voxtet::fem {

/// Square and compressed, a row and a column for each point of the mesh; columns ascend within a row.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Rows from `first` to before `last`.
struct RowRange {
  int first, last;
};
/// Ascending, without overlap.
using RowRanges = std::vector<RowRange>;

/// Row `row` of A x: the sum over its even entries and that over its odd ones, each in the order of columns,
/// then both.
inline double row_product(const SparseMatrix& a, Eigen::Index row, const double* x) {
  const int* const column = a.innerIndexPtr();
  const double* const value = a.valuePtr();
  const int end = a.outerIndexPtr()[row + 1];
  double even = 0, odd = 0;
  int at = a.outerIndexPtr()[row];
  for (; at + 1 < end; at += 2) {
    even += value[at] * x[column[at]];
    odd += value[at + 1] * x[column[at + 1]];
  }
  if (at < end) even += value[at] * x[column[at]];
  return even + odd;
}

/// y = A x, by row_product(). `y` takes the size of `x`; it may not be `x`.
void multiply(const SparseMatrix& a, const Eigen::VectorXd& x, Eigen::VectorXd& y);

/// The sum of x_i y_i, in the order of i. Vectors of the same size.
double dot(const Eigen::VectorXd& x, const Eigen::VectorXd& y);

}  // namespace voxtet::fem
