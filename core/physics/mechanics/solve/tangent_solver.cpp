#include "physics/mechanics/solve/tangent_solver.h"

#include <Eigen/LU>
#include <cmath>
#include <new>
#include <string>
#include <utility>

#include "physics/mechanics/elements/body.h"

namespace voxtet::mechanics {
namespace {

/// Past these with old factors new ones are taken to be cheaper; each costs two products with the factors.
constexpr int kMostWithOldFactors = 12;
constexpr int kMostWithNewFactors = 60;

double dot(const BorderedVector& a, const BorderedVector& b) {
  return fem::dot(a.x, b.x) + fem::dot(a.y, b.y);
}

double norm(const BorderedVector& a) {
  return std::sqrt(dot(a, a));
}

void add(double factor, const BorderedVector& what, BorderedVector& to) {
  to.x += factor * what.x;
  to.y += factor * what.y;
}

BorderedVector product(const BorderedSystem& system, const BorderedVector& v) {
  BorderedVector out;
  fem::multiply(system.matrix, v.x, out.x);
  if (system.add_more) system.add_more(v.x, out.x);
  out.y = system.corner * v.y;
  for (std::size_t i = 0; i < system.border.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    out.x += v.y[row] * system.border[i];
    out.y[row] += fem::dot(system.border[i], v.x);
  }
  return out;
}

/// The inverse of the system with the factors of a matrix near A, and without E.
template <class Factors>
class Preconditioner {
 public:
  Preconditioner(const Factors& factors, const BorderedSystem& system) : factors_(factors), system_(system) {
    Eigen::MatrixXd rest = system.corner;
    for (const Eigen::VectorXd& column : system.border) inverse_border_.emplace_back(factors.solve(column));
    for (std::size_t i = 0; i < inverse_border_.size(); ++i)
      for (std::size_t j = 0; j < inverse_border_.size(); ++j)
        rest(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) -=
            fem::dot(system.border[i], inverse_border_[j]);
    inverse_rest_ = inverse_border_.empty() ? rest : Eigen::MatrixXd(rest.inverse());
  }

  BorderedVector operator()(const BorderedVector& v) const {
    BorderedVector out{factors_.solve(v.x), v.y};
    for (std::size_t i = 0; i < inverse_border_.size(); ++i)
      out.y[static_cast<Eigen::Index>(i)] -= fem::dot(system_.border[i], out.x);
    out.y = inverse_rest_ * out.y;
    for (std::size_t i = 0; i < inverse_border_.size(); ++i)
      out.x -= out.y[static_cast<Eigen::Index>(i)] * inverse_border_[i];
    return out;
  }

 private:
  const Factors& factors_;
  const BorderedSystem& system_;
  std::vector<Eigen::VectorXd> inverse_border_;
  Eigen::MatrixXd inverse_rest_;
};

}  // namespace

Status TangentSolver::factorise(const fem::SparseMatrix& a) {
  ++factorisations_;
  try {
    const Eigen::SparseMatrix<double> by_column(a);
    if (!factors_) {
      factors_ = std::make_unique<Factors>();
      factors_->analyzePattern(by_column);
    }
    factors_->factorize(by_column);
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

bool TangentSolver::iterate(const BorderedSystem& system, const BorderedVector& right, double tolerance,
                            int most, BorderedVector& found) {
  found = {Eigen::VectorXd::Zero(right.x.size()), Eigen::VectorXd::Zero(right.y.size())};
  const double size = norm(right);
  if (size == 0) return true;
  const Preconditioner<Factors> precondition(*factors_, system);
  std::vector<BorderedVector> basis{right};
  basis[0].x /= size;
  basis[0].y /= size;
  // The least-squares problem of GMRES, kept triangular by rotations.
  Eigen::MatrixXd triangle = Eigen::MatrixXd::Zero(most + 1, most);
  Eigen::VectorXd left = Eigen::VectorXd::Zero(most + 1), cosine(most), sine(most);
  left[0] = size;
  int n = 0;
  while (n < most && std::abs(left[n]) > tolerance * size) {
    BorderedVector next = product(system, precondition(basis.back()));
    for (int i = 0; i <= n; ++i) {
      triangle(i, n) = dot(basis[static_cast<std::size_t>(i)], next);
      add(-triangle(i, n), basis[static_cast<std::size_t>(i)], next);
    }
    const double rest = norm(next);
    if (!std::isfinite(rest)) return false;
    for (int i = 0; i < n; ++i) {
      const double upper = triangle(i, n), lower = triangle(i + 1, n);
      triangle(i, n) = cosine[i] * upper + sine[i] * lower;
      triangle(i + 1, n) = cosine[i] * lower - sine[i] * upper;
    }
    const double length = std::sqrt(triangle(n, n) * triangle(n, n) + rest * rest);
    if (length == 0) return false;
    cosine[n] = triangle(n, n) / length;
    sine[n] = rest / length;
    triangle(n, n) = length;
    left[n + 1] = -sine[n] * left[n];
    left[n] *= cosine[n];
    ++n;
    ++iterations_;
    if (rest == 0) break;
    next.x /= rest;
    next.y /= rest;
    basis.push_back(std::move(next));
  }
  if (std::abs(left[n]) > tolerance * size) return false;
  BorderedVector sum = found;
  for (int i = n - 1; i >= 0; --i) {
    for (int j = i + 1; j < n; ++j) left[i] -= triangle(i, j) * left[j];
    left[i] /= triangle(i, i);
  }
  for (int i = 0; i < n; ++i) add(left[i], basis[static_cast<std::size_t>(i)], sum);
  found = precondition(sum);
  return true;
}

Result<BorderedVector> TangentSolver::solve(const BorderedSystem& system, const BorderedVector& right,
                                            double tolerance) {
  BorderedVector found;
  if (factors_ && iterate(system, right, tolerance, kMostWithOldFactors, found)) return found;
  if (Status done = factorise(system.matrix); !done) return done.error();
  if (iterate(system, right, tolerance, kMostWithNewFactors, found)) return found;
  return Error{
      ErrorCode::kMeshing,
      kMechanicsStage,
      "the linear equations were not solved in " + std::to_string(kMostWithNewFactors) + " iterations",
      {}};
}

Result<Eigen::VectorXd> TangentSolver::solve(const fem::SparseMatrix& matrix, const Eigen::VectorXd& right,
                                             double tolerance) {
  Result<BorderedVector> found = solve(BorderedSystem{matrix}, BorderedVector{right, {}}, tolerance);
  if (!found) return found.error();
  return std::move(found->x);
}

}  // namespace voxtet::mechanics
