// Linear systems of tangents that change little from one to the next.
#pragma once

#include <Eigen/SparseLU>
#include <memory>

#include "physics/fem/fixed_order.h"
#include "types/result.h"

namespace voxtet::mechanics {

/// Solves A x = b for matrices of one pattern, symmetric or not. The first one is factorised (sparse LU with
/// COLAMD); those that follow take its factors as the preconditioner of BiCGSTAB (van der Vorst, SIAM Journal
/// on Scientific and Statistical Computing 13 (1992)), and are factorised themselves where that takes too
/// many iterations. All in one fixed order of operations on one thread.
class TangentSolver {
 public:
  /// To |b - A x| <= 1e-8 |b|. Returns kMeshing for a matrix that is singular, kOutOfMemory for one whose
  /// factors do not fit.
  Result<Eigen::VectorXd> solve(const fem::SparseMatrix& a, const Eigen::VectorXd& b);

  int factorisations() const { return factorisations_; }

 private:
  using Factors = Eigen::SparseLU<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>>;
  Status factorise(const fem::SparseMatrix& a);
  /// Whether it came to the tolerance.
  bool iterate(const fem::SparseMatrix& a, const Eigen::VectorXd& b, Eigen::VectorXd& x) const;

  std::unique_ptr<Factors> factors_;
  int factorisations_ = 0;
};

}  // namespace voxtet::mechanics
