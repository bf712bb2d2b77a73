// Conjugate gradients with Jacobi's preconditioner, in one fixed order of operations.
// Hestenes and Stiefel, "Methods of conjugate gradients for solving linear systems" (1952); Saad, "Iterative
// Methods for Sparse Linear Systems" (2003), algorithm 9.1.
#pragma once

#include <Eigen/Core>

#include "physics/fem/fixed_order.h"
#include "types/result.h"

namespace voxtet::fem {

struct PcgParams {
  double relative_tolerance = 1e-10;  ///< stops at |b - A x| <= relative_tolerance |b|, Euclidean norms
  int max_iterations = 1000;
};

struct PcgSolution {
  Eigen::VectorXd x;
  int iterations = 0;
};

/// Solves A x = b for a symmetric positive definite A, from `x0`; the vectors have a value for each row of A,
/// x the unit of b over that of A. Returns kInternal for sizes that differ, a matrix found not to be positive
/// definite, and when the tolerance is not met within `max_iterations`.
Result<PcgSolution> solve_pcg(const SparseMatrix& a, const Eigen::VectorXd& b, const Eigen::VectorXd& x0,
                              const PcgParams& params);

}  // namespace voxtet::fem
