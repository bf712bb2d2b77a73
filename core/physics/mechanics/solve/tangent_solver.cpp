#include "physics/mechanics/solve/tangent_solver.h"

#include <cmath>
#include <new>
#include <string>

#include "physics/mechanics/elements/body.h"

namespace voxtet::mechanics {
namespace {

constexpr double kTolerance = 1e-8;
/// Each takes two products with the factors. Past these a factorisation is taken to be cheaper.
constexpr int kMostIterations = 12;

double norm(const Eigen::VectorXd& x) {
  return std::sqrt(fem::dot(x, x));
}

}  // namespace

Status TangentSolver::factorise(const fem::SparseMatrix& a) {
  ++factorisations_;
  if (!factors_) factors_ = std::make_unique<Factors>();
  try {
    factors_->compute(Eigen::SparseMatrix<double>(a));
  } catch (const std::bad_alloc&) {
    factors_.reset();
    return Error{ErrorCode::kOutOfMemory,
                 kMechanicsStage,
                 "the factors of " + std::to_string(a.rows()) + " equations do not fit into memory",
                 {}};
  }
  if (factors_->info() == Eigen::Success) return std::monostate{};
  factors_.reset();
  return Error{ErrorCode::kMeshing,
               kMechanicsStage,
               "the tangent of " + std::to_string(a.rows()) +
                   " equations is singular: expected enough held or springy points",
               {}};
}

bool TangentSolver::iterate(const fem::SparseMatrix& a, const Eigen::VectorXd& b, Eigen::VectorXd& x) const {
  const double enough = kTolerance * norm(b);
  x = factors_->solve(b);
  Eigen::VectorXd product, step, image, half, half_step, half_image;
  fem::multiply(a, x, product);
  Eigen::VectorXd residual = b - product;
  const Eigen::VectorXd shadow = residual;
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(b.size());
  double rho = 1, alpha = 1, omega = 1;
  for (int i = 0; i <= kMostIterations; ++i) {
    if (norm(residual) <= enough) return true;
    const double next = fem::dot(shadow, residual);
    if (next == 0 || omega == 0) return false;
    if (i == 0) {
      direction = residual;
    } else {
      const double beta = next / rho * (alpha / omega);
      direction = residual + beta * (direction - omega * image);
    }
    rho = next;
    step = factors_->solve(direction);
    fem::multiply(a, step, image);
    alpha = rho / fem::dot(shadow, image);
    half = residual - alpha * image;
    half_step = factors_->solve(half);
    fem::multiply(a, half_step, half_image);
    const double length = fem::dot(half_image, half_image);
    omega = length > 0 ? fem::dot(half_image, half) / length : 0;
    x += alpha * step + omega * half_step;
    residual = half - omega * half_image;
    if (!std::isfinite(norm(residual))) return false;
  }
  return false;
}

Result<Eigen::VectorXd> TangentSolver::solve(const fem::SparseMatrix& a, const Eigen::VectorXd& b) {
  Eigen::VectorXd x;
  if (factors_ && iterate(a, b, x)) return x;
  if (Status done = factorise(a); !done) return done.error();
  return Eigen::VectorXd(factors_->solve(b));
}

}  // namespace voxtet::mechanics
