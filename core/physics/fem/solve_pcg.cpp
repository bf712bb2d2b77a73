#include "physics/fem/solve_pcg.h"

#include <algorithm>
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

/// Where the first residual is below this share of what a value may have left at the end, nothing is solved.
constexpr double kSettled = 0.1;

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
  solve.residual_ = solve.direction_ = solve.product_ = Eigen::VectorXd::Zero(b.size());
  solve.start_again(a, b, std::move(x0), {{0, static_cast<int>(b.size())}});
  return solve;
}

void PcgSolve::start_again(const SparseMatrix& a, const Eigen::VectorXd& b, Eigen::VectorXd x0,
                           RowRanges rows) {
  for (const auto [first, last] : rows_) direction_.segment(first, last - first).setZero();
  rows_ = std::move(rows);
  x_ = std::move(x0);
  iterations_ = 0;
  previous_ = 0;
  double b2 = 0;
  for (const auto [first, last] : rows_)
    for (int i = first; i < last; ++i) b2 += b[i] * b[i];
  b_norm_ = std::sqrt(b2);
  if (b_norm_ == 0) x_.setZero();  // the solution, which no number of iterations would reach exactly
  current_ = residual2_ = 0;
  const double* const x = x_.data();
  double count = 0;
  for (const auto [first, last] : rows_) count += last - first;
  const double settled = kSettled * params_.relative_tolerance * b_norm_ / std::sqrt(count);
  std::erase_if(rows_, [&](const RowRange& range) {
    double largest = 0;
    for (int i = range.first; i < range.last; ++i) {
      residual_[i] = b[i] - row_product(a, i, x);
      largest = std::max(largest, std::abs(residual_[i]));
    }
    return largest <= settled;
  });
  for (const auto [first, last] : rows_)
    for (int i = first; i < last; ++i) add_residual(i);
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

void PcgSolve::add_residual(int i) {
  const double square = residual_[i] * residual_[i];
  residual2_ += square;
  current_ += square * inverse_diagonal_[i];
}

Status PcgSolve::iterate_once(const SparseMatrix& a) {
  const double keep = previous_ > 0 ? current_ / previous_ : 0;
  double* const direction = direction_.data();
  for (const auto [first, last] : rows_)
    for (int i = first; i < last; ++i)
      direction[i] = residual_[i] * inverse_diagonal_[i] + keep * direction[i];
  previous_ = current_;

  double curvature = 0;
  for (const auto [first, last] : rows_)
    for (int i = first; i < last; ++i) {
      product_[i] = row_product(a, i, direction);
      curvature += direction[i] * product_[i];
    }
  if (!(curvature > 0)) return not_positive("p . A p of a search direction p", curvature);
  const double step = current_ / curvature;
  current_ = residual2_ = 0;
  for (const auto [first, last] : rows_)
    for (int i = first; i < last; ++i) {
      x_[i] += step * direction[i];
      residual_[i] -= step * product_[i];
      add_residual(i);
    }
  ++iterations_;
  return std::monostate{};
}

}  // namespace voxtet::fem
