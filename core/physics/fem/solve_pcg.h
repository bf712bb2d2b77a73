// Conjugate gradients with Jacobi's preconditioner, in one fixed order of operations.
// Hestenes and Stiefel, "Methods of conjugate gradients for solving linear systems" (1952); Saad, "Iterative
// Methods for Sparse Linear Systems" (2003), algorithm 9.1.
#pragma once

#include <Eigen/Core>
#include <utility>

#include "physics/fem/fixed_order.h"
#include "types/result.h"

namespace voxtet::fem {

struct PcgParams {
  double relative_tolerance = 1e-10;  ///< stops at |b - A x| <= relative_tolerance |b|, Euclidean norms
  int max_iterations = 1000;
};

/// A solve of A x = b under way, for a symmetric positive definite A: a value that its caller may leave
/// between two iterations and take up later. However it is cut, x has the same bytes. The vectors have a
/// value for each row of A, x the unit of b over that of A. A is not kept: every call is given the same one.
class PcgSolve {
 public:
  /// Begins at `x0`. Returns kInternal for sizes that differ, and for a diagonal that is not positive.
  static Result<PcgSolve> start(const SparseMatrix& a, const Eigen::VectorXd& b, Eigen::VectorXd x0,
                                const PcgParams& params);

  /// The same for another b, in those rows alone: elsewhere x stays 0, and so must `x0` be. x also stays as
  /// it is in ranges of rows whose residual is small from the beginning (a tenth of what each row may have
  /// left at the end). `a` is the matrix that start() had; its vectors are used again.
  void start_again(const SparseMatrix& a, const Eigen::VectorXd& b, Eigen::VectorXd x0, RowRanges rows);
  /// Gives up x, for the next start.
  Eigen::VectorXd take_x() { return std::move(x_); }

  /// At most so many iterations; true when x meets the tolerance. Returns kInternal for a matrix found not to
  /// be positive definite, and when the tolerance is not met within `max_iterations` of all calls.
  Result<bool> iterate(const SparseMatrix& a, int iterations);

  int iterations() const { return iterations_; }
  const Eigen::VectorXd& x() const { return x_; }

 private:
  PcgSolve() = default;
  Status iterate_once(const SparseMatrix& a);
  void add_residual(int i);  ///< of row i to the sums

  PcgParams params_;
  RowRanges rows_;
  double b_norm_ = 0;
  double residual2_ = 0;               ///< r . r
  double current_ = 0, previous_ = 0;  ///< r . P^-1 r now, and in the iteration before
  int iterations_ = 0;
  Eigen::VectorXd x_, inverse_diagonal_, residual_, direction_, product_;
};

}  // namespace voxtet::fem
