#include "physics/mechanics/elements/element_forces.h"

#include <Eigen/Geometry>

namespace voxtet::mechanics {
namespace {

/// d(F S) / dF: [J][L](i, k) is the derivative of (F S)_iJ by F_kL.
using Moduli = std::array<std::array<Eigen::Matrix3d, 3>, 3>;

Moduli moduli_of(const Eigen::Matrix3d& f, const Eigen::Matrix3d& stress, const Tensor66& tangent) {
  constexpr int kNumber[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};  // of Tensor6
  Moduli moduli;
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t l = j; l < 3; ++l) {
      Eigen::Matrix3d d;
      for (int m = 0; m < 3; ++m)
        for (int n = 0; n < 3; ++n) d(m, n) = tangent(kNumber[m][j], kNumber[n][l]);
      moduli[j][l] = f * d * f.transpose();
      moduli[j][l].diagonal().array() += stress(static_cast<int>(j), static_cast<int>(l));
      if (l > j) moduli[l][j] = moduli[j][l].transpose();
    }
  return moduli;
}

}  // namespace

Eigen::Matrix3d cofactor(const Eigen::Matrix3d& f) {
  Eigen::Matrix3d out;
  for (int i = 0; i < 3; ++i) out.col(i) = f.col((i + 1) % 3).cross(f.col((i + 2) % 3));
  return out;
}

ElementForces::ElementForces(std::size_t nodes, bool with_tangent)
    : nodes_(nodes), with_tangent_(with_tangent) {
  for (std::size_t a = 0; a < nodes; ++a) {
    force_[a].setZero();
    for (std::size_t b = a; with_tangent && b < nodes; ++b) tangent_[10 * a + b].setZero();
  }
}

void ElementForces::add(double weight, const Eigen::Matrix3d& f, const Response& response,
                        const Shape* shapes) {
  const Eigen::Matrix3d stress = weight * matrix_of(response.stress);
  const Eigen::Matrix3d first_piola = f * stress;
  for (std::size_t a = 0; a < nodes_; ++a) force_[a] += first_piola * shapes[a].gradient;
  if (!with_tangent_) return;
  const Moduli moduli = moduli_of(f, stress, weight * response.tangent);
  for (std::size_t a = 0; a < nodes_; ++a) {
    const Eigen::Vector3d& g = shapes[a].gradient;
    std::array<Eigen::Matrix3d, 3> along;
    for (std::size_t l = 0; l < 3; ++l)
      along[l] = g[0] * moduli[0][l] + g[1] * moduli[1][l] + g[2] * moduli[2][l];
    for (std::size_t b = a; b < nodes_; ++b) {
      const Eigen::Vector3d& h = shapes[b].gradient;
      tangent_[10 * a + b] += h[0] * along[0] + h[1] * along[1] + h[2] * along[2];
    }
  }
}

}  // namespace voxtet::mechanics
