#include "physics/fem/solve_pcg.h"

#include <cmath>
#include <sstream>
#include <utility>

namespace voxtet::fem {
namespace {

Error solver_error(const std::string& message) {
  return {ErrorCode::kInternal, "solve_pcg", message, {}};
}

Error not_positive(const char* what, double found) {
  std::ostringstream message;
  message << what << ": found " << found << ", expected more than 0 of a positive definite matrix";
  return solver_error(message.str());
}

Error not_converged(double relative_residual, const PcgParams& params) {
  std::ostringstream message;
  message << "relative residual after " << params.max_iterations << " iterations: found " << relative_residual
          << ", expected at most " << params.relative_tolerance;
  return solver_error(message.str());
}

Error sizes_differ(const SparseMatrix& a, const Eigen::VectorXd& b, const Eigen::VectorXd& x0) {
  std::ostringstream message;
  message << "sizes: found a matrix of " << a.rows() << " x " << a.cols() << ", " << b.size()
          << " values of b and " << x0.size() << " of x0, expected them to agree";
  return solver_error(message.str());
}

/// y = A p, and returns p . y.
double multiply_and_dot(const SparseMatrix& a, const Eigen::VectorXd& p, Eigen::VectorXd& y) {
  const int* const row = a.outerIndexPtr();
  const int* const column = a.innerIndexPtr();
  const double* const value = a.valuePtr();
  double sum = 0;
  for (Eigen::Index i = 0; i < p.size(); ++i) {
    double entry = 0;
    for (int at = row[i]; at < row[i + 1]; ++at) entry += value[at] * p[column[at]];
    y[i] = entry;
    sum += p[i] * entry;
  }
  return sum;
}

}  // namespace

Result<PcgSolve> PcgSolve::start(const SparseMatrix& a, const Eigen::VectorXd& b, Eigen::VectorXd x0,
                                 const PcgParams& params) {
  if (a.rows() != a.cols() || b.size() != a.rows() || x0.size() != a.rows()) return sizes_differ(a, b, x0);
  PcgSolve solve;
  solve.params_ = params;
  solve.inverse_diagonal_ = a.diagonal();
  for (double& entry : solve.inverse_diagonal_) {
    if (!(entry > 0)) return not_positive("diagonal entry", entry);
    entry = 1 / entry;
  }
  solve.b_norm_ = std::sqrt(dot(b, b));
  solve.x_ = std::move(x0);
  if (solve.b_norm_ == 0)
    solve.x_.setZero();  // the solution, which no number of iterations would reach exactly
  multiply(a, solve.x_, solve.product_);
  solve.residual_ = b;
  for (Eigen::Index i = 0; i < b.size(); ++i) solve.residual_[i] -= solve.product_[i];
  solve.direction_ = Eigen::VectorXd::Zero(b.size());
  solve.sum_residual();
  return solve;
}

Result<bool> PcgSolve::iterate(const SparseMatrix& a, int iterations) {
  for (int done = 0;; ++done) {
    const double relative_residual = b_norm_ == 0 ? 0 : std::sqrt(residual2_) / b_norm_;
    if (relative_residual <= params_.relative_tolerance) return true;
    if (iterations_ == params_.max_iterations) return not_converged(relative_residual, params_);
    if (done == iterations) return false;
    if (Status iterated = iterate_once(a); !iterated) return iterated.error();
  }
}

void PcgSolve::sum_residual() {
  current_ = residual2_ = 0;
  for (Eigen::Index i = 0; i < residual_.size(); ++i) {
    const double square = residual_[i] * residual_[i];
    residual2_ += square;
    current_ += square * inverse_diagonal_[i];
  }
}

Status PcgSolve::iterate_once(const SparseMatrix& a) {
  const double keep = previous_ > 0 ? current_ / previous_ : 0;
  for (Eigen::Index i = 0; i < x_.size(); ++i)
    direction_[i] = residual_[i] * inverse_diagonal_[i] + keep * direction_[i];
  previous_ = current_;

  const double curvature = multiply_and_dot(a, direction_, product_);
  if (!(curvature > 0)) return not_positive("p . A p of a search direction p", curvature);
  const double step = current_ / curvature;
  for (Eigen::Index i = 0; i < x_.size(); ++i) {
    x_[i] += step * direction_[i];
    residual_[i] -= step * product_[i];
  }
  sum_residual();
  ++iterations_;
  return std::monostate{};
}

}  // namespace voxtet::fem
