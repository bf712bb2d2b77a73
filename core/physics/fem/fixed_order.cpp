#include "physics/fem/fixed_order.h"

namespace voxtet::fem {

void multiply(const SparseMatrix& a, const Eigen::VectorXd& x, Eigen::VectorXd& y) {
  const int* const row_begin = a.outerIndexPtr();
  const int* const column = a.innerIndexPtr();
  const double* const value = a.valuePtr();
  y.resize(x.size());
  for (Eigen::Index row = 0; row < a.rows(); ++row) {
    double sum = 0;
    for (int at = row_begin[row]; at < row_begin[row + 1]; ++at) sum += value[at] * x[column[at]];
    y[row] = sum;
  }
}

double dot(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  double sum = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}

}  // namespace voxtet::fem
