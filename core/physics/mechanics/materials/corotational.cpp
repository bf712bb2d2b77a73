#include "physics/mechanics/materials/corotational.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace voxtet::mechanics {
namespace {

constexpr double kRoot2 = 1.41421356237309504880;

/// Symmetric tensors as vectors whose dot product is that of the tensors, and pairs of them as matrices:
/// shears times the root of 2.
Tensor6 weights() {
  return (Tensor6() << 1, 1, 1, kRoot2, kRoot2, kRoot2).finished();
}

Tensor6 vector_of(const Eigen::Matrix3d& symmetric) {
  return tensor6(symmetric).cwiseProduct(weights());
}

Eigen::Matrix3d tensor_of(const Tensor6& vector) {
  return matrix_of(vector.cwiseQuotient(weights()));
}

/// (a b^T + b a^T) / 2.
Tensor6 dyad(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return vector_of((a * b.transpose() + b * a.transpose()) / 2);
}

/// Of X the tensor (a X + X a) / 2.
Tensor66 symmetric_product(const Eigen::Matrix3d& a) {
  Tensor66 out;
  for (int i = 0; i < 6; ++i) {
    const Eigen::Matrix3d x = tensor_of(Tensor6::Unit(i));
    out.col(i) = vector_of((a * x + x * a) / 2);
  }
  return out;
}

/// D of W = e . D e / 2.
Tensor66 corotational_moduli(const Corotational& m, const Eigen::Matrix3d& frame) {
  const Eigen::Vector3d f = frame.col(0);
  const Tensor6 one = vector_of(Eigen::Matrix3d::Identity());
  const Tensor6 fs = dyad(f, frame.col(1)), fn = dyad(f, frame.col(2)), ff = dyad(f, f) - one / 3;
  return 2 * m.shear_across_kpa * (Tensor66::Identity() - one * one.transpose() / 3) +
         4 * (m.shear_along_kpa - m.shear_across_kpa) * (fs * fs.transpose() + fn * fn.transpose()) +
         m.fibre_kpa * ff * ff.transpose();
}

}  // namespace

Response respond_corotational(const Corotational& material, const Eigen::Matrix3d& c,
                              const Eigen::Matrix3d& frame) {
  // From U U = C, with A X = U X + X U: dU = 2 A^-1 dE, S = 2 A^-1 D e, and the second derivative of U is
  // -A^-1 (dU dU' + dU' dU). None of it minds equal stretches or their order.
  const Eigen::Matrix3d u = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(c).operatorSqrt();
  const Tensor66 moduli = corotational_moduli(material, frame);
  const Tensor6 e = vector_of(u - Eigen::Matrix3d::Identity()), biot = moduli * e;
  const Tensor66 per_strain = symmetric_product(u).inverse();  // dU / dE
  const Tensor6 stress = per_strain * biot;
  const Tensor66 tangent = per_strain * (moduli - symmetric_product(tensor_of(stress))) * per_strain;
  Response response;
  response.energy_kpa = e.dot(biot) / 2;
  response.stress = stress.cwiseQuotient(weights());
  response.tangent = tangent.cwiseQuotient(weights() * weights().transpose());
  return response;
}

}  // namespace voxtet::mechanics
