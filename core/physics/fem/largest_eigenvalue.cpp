#include "physics/fem/largest_eigenvalue.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace voxtet::fem {
namespace {

constexpr int kSteps = 40;
constexpr double kMargin = 1.05;

/// Values from -1 to 1 without order, so that every eigenvector has a part in them.
Eigen::VectorXd without_order(Eigen::Index count) {
  Eigen::VectorXd x(count);
  for (Eigen::Index i = 0; i < count; ++i)
    x[i] = static_cast<double>(static_cast<std::uint32_t>(i + 1) * 2654435761U) / 2147483648.0 - 1;
  return x;
}

}  // namespace

double largest_eigenvalue_bound(const SparseMatrix& k, const Eigen::VectorXd& mass) {
  Eigen::VectorXd x = without_order(mass.size()), product(mass.size());
  double value = 0;
  for (int step = 0; step < kSteps; ++step) {
    multiply(k, x, product);
    double energy = 0, norm2 = 0, longest = 0;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      energy += x[i] * product[i];
      norm2 += x[i] * (mass[i] * x[i]);
      x[i] = product[i] / mass[i];
      longest = std::max(longest, std::abs(x[i]));
    }
    value = energy / norm2;
    if (!(longest > 0)) break;
    for (double& entry : x) entry /= longest;
  }
  return kMargin * value;
}

}  // namespace voxtet::fem
