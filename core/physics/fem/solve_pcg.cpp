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

/// y += factor x
void add(Eigen::VectorXd& y, double factor, const Eigen::VectorXd& x) {
  for (Eigen::Index i = 0; i < y.size(); ++i) y[i] += factor * x[i];
}

}  // namespace

Result<PcgSolve> PcgSolve::start(const SparseMatrix& a, const Eigen::VectorXd& b, Eigen::VectorXd x0,
                                 const PcgParams& params) {
  if (a.rows() != a.cols() || b.size() != a.rows() || x0.size() != a.rows()) return sizes_differ(a, b, x0);
  PcgSolve solve;
  solve.params_ = params;
  solve.diagonal_ = a.diagonal();
  for (const double entry : solve.diagonal_)
    if (!(entry > 0)) return not_positive("diagonal entry", entry);
  solve.b_norm_ = std::sqrt(dot(b, b));
  solve.x_ = std::move(x0);
  if (solve.b_norm_ == 0)
    solve.x_.setZero();  // the solution, which no number of iterations would reach exactly
  multiply(a, solve.x_, solve.product_);
  solve.residual_ = b;
  add(solve.residual_, -1, solve.product_);
  solve.direction_ = Eigen::VectorXd::Zero(b.size());
  return solve;
}

Result<bool> PcgSolve::iterate(const SparseMatrix& a, int iterations) {
  for (int done = 0;; ++done) {
    const double relative_residual = b_norm_ == 0 ? 0 : std::sqrt(dot(residual_, residual_)) / b_norm_;
    if (relative_residual <= params_.relative_tolerance) return true;
    if (iterations_ == params_.max_iterations) return not_converged(relative_residual, params_);
    if (done == iterations) return false;
    if (Status iterated = iterate_once(a); !iterated) return iterated.error();
  }
}

Status PcgSolve::iterate_once(const SparseMatrix& a) {
  double current = 0;
  for (Eigen::Index i = 0; i < x_.size(); ++i) current += residual_[i] * (residual_[i] / diagonal_[i]);
  const double keep = previous_ > 0 ? current / previous_ : 0;
  for (Eigen::Index i = 0; i < x_.size(); ++i)
    direction_[i] = residual_[i] / diagonal_[i] + keep * direction_[i];
  previous_ = current;

  multiply(a, direction_, product_);
  const double curvature = dot(direction_, product_);
  if (!(curvature > 0)) return not_positive("p . A p of a search direction p", curvature);
  const double step = current / curvature;
  add(x_, step, direction_);
  add(residual_, -step, product_);
  ++iterations_;
  return std::monostate{};
}

}  // namespace voxtet::fem
