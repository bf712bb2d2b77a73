// What muscle answers to a deformation: hyperelastic materials with fibres, and the stress that fibres make.
// Stresses in kPa. F is the deformation gradient, C = F^T F, E = (C - I) / 2, J = det F.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <variant>

namespace voxtet::mechanics {

// I1 = tr C, I2 = (I1^2 - tr C^2) / 2; I1' = J^-2/3 I1 and I2' = J^-4/3 I2 do not see a change of volume.
// I4f = f . C f and I8 = f . C s do. (x)+ is x where it is positive, else 0.

/// c1 (I1' - 3) + c2 (I2' - 3). With c2 = 0 neo-Hookean, of the shear modulus 2 c1.
struct MooneyRivlin {
  double c1_kpa = 1;
  double c2_kpa = 0;
};

/// c1 (I1' - 3) + c2 (I2' - 3) + a / 2b (exp(b (I4f - 1)+^2) - 1): isotropic, with fibres that resist
/// stretch. With less than 3 kPa for c1 a ventricle that contracts buckles at its base, as quadratic elements
/// show and linear ones hide.
struct TransverselyIsotropic {
  double c1_kpa = 3;
  double c2_kpa = 0.3;
  double a_f_kpa = 1.5;
  double b_f = 8;
};

/// Holzapfel and Ogden, Phil. Trans. R. Soc. A 367 (2009):
///
///     a / 2b (exp(b (I1' - 3)) - 1) + sum over i = f, s of x(I4i) a_i / 2b_i (exp(b_i (I4i - 1)^2) - 1)
///     + a_fs / 2b_fs (exp(b_fs I8^2) - 1),   x(I) = 1 / (1 + exp(-k (I - 1)))
///
/// The values and the smooth switch x are those of Arostica et al., Computer Methods in Applied Mechanics and
/// Engineering 435 (2025).
struct HolzapfelOgden {
  double a_kpa = 0.059, b = 8.023;
  double a_f_kpa = 18.472, b_f = 16.026;
  double a_s_kpa = 2.481, b_s = 11.120;
  double a_fs_kpa = 0.216, b_fs = 11.436;
  double k = 100;  ///< how steep the switch is
};

/// Guccione, McCulloch and Waldman, Journal of Biomechanical Engineering 113 (1991), in the form of Land et
/// al., Proceedings of the Royal Society A 471 (2015): c / 2 (exp(Q) - 1) with
///
///     Q = b_f Eff^2 + b_t (Ess^2 + Enn^2 + 2 Esn^2) + 2 b_fs (Efs^2 + Efn^2)
struct Guccione {
  double c_kpa = 2;
  double b_f = 8, b_t = 2, b_fs = 4;
};

/// Linear elasticity in a frame that turns with the body, transversely isotropic: with F = R U, R a rotation,
/// and e what R^T F - I = U - I is without a third of its trace,
///
///     shear_across (e : e) + 2 (shear_along - shear_across) (efs^2 + efn^2) + fibre / 2 eff^2
///
/// It does not stiffen, and so is for small stretches. Its own values are those of TransverselyIsotropic
/// where fibres are hardly stretched.
struct Corotational {
  double shear_across_kpa = 6.6, shear_along_kpa = 6.6;
  double fibre_kpa = 6;  ///< what fibres add to stiffness along them
};

using Material = std::variant<TransverselyIsotropic, HolzapfelOgden, Guccione, MooneyRivlin, Corotational>;

/// What is wrong with a parameter: its name, what was found and what was expected. Stiffnesses are finite and
/// not negative, exponents and k are more than 0.
std::optional<std::string> fault_of(const Material& material);

/// The same material with all stresses times a factor.
Material scaled(const Material& material, double factor);

/// The six numbers of a symmetric tensor: 00, 11, 22, 01, 12, 02.
using Tensor6 = Eigen::Matrix<double, 6, 1>;
/// Of pairs of such tensors. Times (e00, e11, e22, 2 e01, 2 e12, 2 e02) it is the product with a tensor e.
using Tensor66 = Eigen::Matrix<double, 6, 6>;

Tensor6 tensor6(const Eigen::Matrix3d& symmetric);
Eigen::Matrix3d matrix_of(const Tensor6& tensor);

/// At one place, for one deformation.
struct Response {
  double energy_kpa = 0;                ///< W, by undeformed volume; 0 at rest
  Tensor6 stress = Tensor6::Zero();     ///< S = dW/dE, the second Piola-Kirchhoff stress, kPa
  Tensor66 tangent = Tensor66::Zero();  ///< dS/dE, kPa
};

/// Of the material without its resistance to a change of volume, which an element adds. `c` has a positive
/// determinant. The columns of `frame` are orthonormal: the undeformed fibre, sheet and sheet normal.
Response response_of(const Material& material, const Eigen::Matrix3d& c, const Eigen::Matrix3d& frame);

/// At rest, the mean over all directions: a tenth of the trace of dS/dE among tensors without trace. Of an
/// isotropic material its shear modulus.
double mean_shear_modulus_kpa(const Material& material);

/// Adds the stress `tension_kpa` along the undeformed fibre, S = tension f f^T: its energy is tension
/// (I4f - 1) / 2 for a tension that does not change with stretch.
void add_active_stress(double tension_kpa, const Eigen::Vector3d& fibre, Response& response);

/// Adds the stress of a change of strain in a step: S = kpa (E - E before), where `kpa` is viscosity over
/// step.
void add_viscous_stress(double kpa, const Eigen::Matrix3d& change_of_strain, Response& response);

/// The pressure-like stress p = U'(J), kPa, and its derivative.
struct Volumetric {
  double energy_kpa, pressure_kpa, modulus_kpa;
};

/// U(J) = bulk / 4 (J^2 - 1 - 2 ln J), which no finite energy brings to J = 0; bulk modulus at J = 1.
Volumetric volumetric(double bulk_kpa, double j);

/// The same law by the pressure: J, at which U'(J) is `pressure_kpa`, dJ/dp, and U* = p (J - 1) - U(J), whose
/// derivative is J - 1.
struct Dilation {
  double energy_kpa, j, per_kpa;
};
Dilation dilation(double bulk_kpa, double pressure_kpa);

/// Adds S = p J C^-1 and its derivative, where dp/dJ = modulus_kpa (0: p does not follow this J).
void add_pressure(double pressure_kpa, double modulus_kpa, const Eigen::Matrix3d& c, double j,
                  Response& response);

}  // namespace voxtet::mechanics
