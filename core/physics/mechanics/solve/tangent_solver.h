// Linear systems of tangents that change little from one to the next.
#pragma once

#include <Eigen/SparseCholesky>
#include <functional>
#include <memory>
#include <vector>

#include "physics/fem/fixed_order.h"
#include "types/result.h"

namespace voxtet::mechanics {

/// The equations
///
///     (A + E) x + B y = b
///     B^T x    + G y = c,
///
/// with few y, as the pressures in the cavities of a heart, whose forces E changes with x too.
struct BorderedSystem {
  explicit BorderedSystem(const fem::SparseMatrix& a) : matrix(a) {}

  const fem::SparseMatrix& matrix;  ///< A, symmetric but for a small part
  /// Adds E x to `product`; none: E is 0.
  std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& product)> add_more = {};
  std::vector<Eigen::VectorXd> border = {};  ///< the columns of B
  Eigen::MatrixXd corner = {};               ///< G
};

struct BorderedVector {
  Eigen::VectorXd x, y;
};

/// Solves such systems with matrices A of one pattern. The first one is factorised, its lower half as that of
/// a symmetric matrix, without pivoting (LDL^T with the order of approximate minimum degrees). Those that
/// follow take its factors to precondition GMRES (Saad and Schultz, SIAM Journal on Scientific and
/// Statistical Computing 7 (1986)), and are factorised themselves where that takes too many iterations. All
/// in one fixed order of operations on one thread.
class TangentSolver {
 public:
  /// Until what is left of the right side is `tolerance` of it. Returns kMeshing for a matrix that is
  /// singular and where it does not come to the tolerance, kOutOfMemory for factors that do not fit.
  Result<BorderedVector> solve(const BorderedSystem& system, const BorderedVector& right, double tolerance);
  /// The same without y.
  Result<Eigen::VectorXd> solve(const fem::SparseMatrix& matrix, const Eigen::VectorXd& right,
                                double tolerance);

  /// The next matrix is factorised, as the first one was.
  void forget() { factors_.reset(); }

  int factorisations() const { return factorisations_; }
  int iterations() const { return iterations_; }  ///< of GMRES, all together

 private:
  using Factors = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::AMDOrdering<int>>;
  Status factorise(const fem::SparseMatrix& a);
  /// Whether it came to the tolerance within so many iterations.
  bool iterate(const BorderedSystem& system, const BorderedVector& right, double tolerance, int most,
               BorderedVector& found);

  std::unique_ptr<Factors> factors_;
  int factorisations_ = 0, iterations_ = 0;
};

}  // namespace voxtet::mechanics
