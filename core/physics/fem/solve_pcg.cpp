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

Result<PcgSolution> solve_pcg(const SparseMatrix& a, const Eigen::VectorXd& b, const Eigen::VectorXd& x0,
                              const PcgParams& params) {
  if (a.rows() != a.cols() || b.size() != a.rows() || x0.size() != a.rows()) return sizes_differ(a, b, x0);
  const Eigen::VectorXd diagonal = a.diagonal();
  for (Eigen::Index i = 0; i < diagonal.size(); ++i)
    if (!(diagonal[i] > 0)) return not_positive("diagonal entry", diagonal[i]);
  const double b_norm = std::sqrt(dot(b, b));
  if (b_norm == 0) return PcgSolution{Eigen::VectorXd::Zero(b.size()), 0};

  PcgSolution solution{x0, 0};
  Eigen::VectorXd product;
  multiply(a, x0, product);
  Eigen::VectorXd residual = b;
  add(residual, -1, product);
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(b.size());
  double previous = 0;  // r . P^-1 r of the iteration before
  while (true) {
    const double relative_residual = std::sqrt(dot(residual, residual)) / b_norm;
    if (relative_residual <= params.relative_tolerance) return solution;
    if (solution.iterations == params.max_iterations) return not_converged(relative_residual, params);

    double current = 0;
    for (Eigen::Index i = 0; i < b.size(); ++i) current += residual[i] * (residual[i] / diagonal[i]);
    const double keep = previous > 0 ? current / previous : 0;
    for (Eigen::Index i = 0; i < b.size(); ++i)
      direction[i] = residual[i] / diagonal[i] + keep * direction[i];
    previous = current;

    multiply(a, direction, product);
    const double curvature = dot(direction, product);
    if (!(curvature > 0)) return not_positive("p . A p of a search direction p", curvature);
    const double step = current / curvature;
    add(solution.x, step, direction);
    add(residual, -step, product);
    ++solution.iterations;
  }
}

}  // namespace voxtet::fem
