#include "physics/fem/fixed_order.h"

namespace voxtet::fem {

void multiply(const SparseMatrix& a, const Eigen::VectorXd& x, Eigen::VectorXd& y) {
  y.resize(x.size());
  for (Eigen::Index row = 0; row < a.rows(); ++row) y[row] = row_product(a, row, x.data());
}

double dot(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  double sum = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}

}  // namespace voxtet::fem
