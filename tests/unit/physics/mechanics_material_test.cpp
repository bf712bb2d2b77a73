// Materials: energy, stress and tangent belong together; what a rotation and rest mean to them.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "base/portable_exp.h"
#include "physics/mechanics/materials/material.h"
#include "support/test_random.h"

namespace voxtet::mechanics {
namespace {

const Material kMaterials[] = {TransverselyIsotropic{}, HolzapfelOgden{},   Guccione{},
                               MooneyRivlin{2, 0.7},    MooneyRivlin{2, 0}, Corotational{1.5, 2.5, 7}};
constexpr double kBulk = 50;
constexpr double kTension = 7;

/// Numbers from -size to size.
class Numbers {
 public:
  double next(double size) { return size * (random_.below(2'000'001) - 1'000'000) / 1e6; }
  Eigen::Matrix3d matrix(double size) {
    Eigen::Matrix3d m;
    for (double& x : m.reshaped()) x = next(size);
    return m;
  }
  Eigen::Matrix3d rotation() {
    const Eigen::Matrix3d m = matrix(1);
    Eigen::Matrix3d frame;
    frame.col(0) = m.col(0).normalized();
    frame.col(1) = frame.col(0).cross(m.col(1)).normalized();
    frame.col(2) = frame.col(0).cross(frame.col(1));
    return frame;
  }

 private:
  test::TestRandom random_{20151};
};

/// With pressure and tension, and the energy of both.
Response whole_response(const Material& material, const Eigen::Matrix3d& c, const Eigen::Matrix3d& frame) {
  Response response = response_of(material, c, frame);
  const double j = std::sqrt(c.determinant());
  const Volumetric now = volumetric(kBulk, j);
  add_pressure(now.pressure_kpa, now.modulus_kpa, c, j, response);
  add_active_stress(kTension, frame.col(0), response);
  response.energy_kpa += now.energy_kpa + kTension * (frame.col(0).dot(c * frame.col(0)) - 1) / 2;
  return response;
}

/// C with the strain's number k changed by h: E00 ... E02, each shear on both sides of the diagonal.
Eigen::Matrix3d strained(const Eigen::Matrix3d& c, int k, double h) {
  Tensor6 e = Tensor6::Zero();
  e[k] = h;
  return c + 2 * matrix_of(e);
}

TEST(MechanicsMaterial, StressIsTheDerivativeOfTheEnergy) {
  Numbers numbers;
  constexpr double kStep = 1e-5;
  for (const Material& material : kMaterials)
    for (int trial = 0; trial < 20; ++trial) {
      const Eigen::Matrix3d f = Eigen::Matrix3d::Identity() + numbers.matrix(0.2);
      const Eigen::Matrix3d c = f.transpose() * f, frame = numbers.rotation();
      const Response at = whole_response(material, c, frame);
      for (int k = 0; k < 6; ++k) {
        const double slope = (whole_response(material, strained(c, k, kStep), frame).energy_kpa -
                              whole_response(material, strained(c, k, -kStep), frame).energy_kpa) /
                             (2 * kStep);
        const double expected = (k < 3 ? 1 : 2) * at.stress[k];
        EXPECT_NEAR(slope, expected, 1e-6 * (1 + at.stress.norm())) << material.index() << " " << k;
      }
    }
}

TEST(MechanicsMaterial, TangentIsTheDerivativeOfTheStress) {
  Numbers numbers;
  constexpr double kStep = 1e-5;
  for (const Material& material : kMaterials)
    for (int trial = 0; trial < 20; ++trial) {
      const Eigen::Matrix3d f = Eigen::Matrix3d::Identity() + numbers.matrix(0.2);
      const Eigen::Matrix3d c = f.transpose() * f, frame = numbers.rotation();
      const Response at = whole_response(material, c, frame);
      for (int k = 0; k < 6; ++k) {
        const Tensor6 slope = (whole_response(material, strained(c, k, kStep), frame).stress -
                               whole_response(material, strained(c, k, -kStep), frame).stress) /
                              (2 * kStep);
        const Tensor6 expected = (k < 3 ? 1 : 2) * at.tangent.col(k);
        EXPECT_LT((slope - expected).norm(), 1e-6 * at.tangent.norm()) << material.index() << " " << k;
      }
      EXPECT_LT((at.tangent - at.tangent.transpose()).norm(), 1e-12 * at.tangent.norm());
    }
}

TEST(MechanicsMaterial, RestHasNoStressAndNoEnergy) {
  Numbers numbers;
  for (const Material& material : kMaterials) {
    const Response rest = response_of(material, Eigen::Matrix3d::Identity(), numbers.rotation());
    EXPECT_LT(rest.stress.norm(), 1e-13);
    EXPECT_NEAR(rest.energy_kpa, 0, 1e-14);
  }
  EXPECT_EQ(volumetric(kBulk, 1).pressure_kpa, 0);
  EXPECT_EQ(volumetric(kBulk, 1).modulus_kpa, kBulk);
}

TEST(MechanicsMaterial, DilationIsTheInverseOfThePressure) {
  constexpr double kStep = 1e-6;
  for (const double j : {0.2, 0.9, 1.0, 1.3, 4.0}) {
    const Volumetric now = volumetric(kBulk, j);
    const Dilation same = dilation(kBulk, now.pressure_kpa);
    EXPECT_NEAR(same.j, j, 1e-14);
    EXPECT_NEAR(same.per_kpa, 1 / now.modulus_kpa, 1e-14);
    EXPECT_NEAR(same.energy_kpa, now.pressure_kpa * (j - 1) - now.energy_kpa, 1e-12);
    const double slope = (dilation(kBulk, now.pressure_kpa + kStep).energy_kpa -
                          dilation(kBulk, now.pressure_kpa - kStep).energy_kpa) /
                         (2 * kStep);
    EXPECT_NEAR(slope, j - 1, 1e-7);
  }
}

TEST(MechanicsMaterial, MeanShearModulusIsTheShearModulusOfAnIsotropicMaterial) {
  EXPECT_NEAR(mean_shear_modulus_kpa(MooneyRivlin{1.5, 0.4}), 2 * (1.5 + 0.4), 1e-13);
  // c b / 2 where all three exponents are b.
  EXPECT_NEAR(mean_shear_modulus_kpa(Guccione{10, 1, 1, 1}), 5, 1e-13);
  EXPECT_NEAR(mean_shear_modulus_kpa(Corotational{2, 2, 0}), 2, 1e-13);
  EXPECT_GT(mean_shear_modulus_kpa(Guccione{2, 8, 2, 4}), 2);
  EXPECT_LT(mean_shear_modulus_kpa(Guccione{2, 8, 2, 4}), 8);
}

TEST(MechanicsMaterial, MuscleTurnedWithItsFibresAnswersTurned) {
  Numbers numbers;
  for (const Material& material : kMaterials)
    for (int trial = 0; trial < 10; ++trial) {
      const Eigen::Matrix3d f = Eigen::Matrix3d::Identity() + numbers.matrix(0.2);
      const Eigen::Matrix3d c = f.transpose() * f, frame = numbers.rotation(), turn = numbers.rotation();
      const Response here = whole_response(material, c, frame);
      const Response there = whole_response(material, turn * c * turn.transpose(), turn * frame);
      EXPECT_NEAR(here.energy_kpa, there.energy_kpa, 1e-10 * (1 + std::abs(here.energy_kpa)));
      EXPECT_LT((turn * matrix_of(here.stress) * turn.transpose() - matrix_of(there.stress)).norm(),
                1e-10 * (1 + here.stress.norm()));
    }
}

TEST(MechanicsMaterial, AStifferOneHasTheSameResponseTimesItsFactor) {
  Numbers numbers;
  for (const Material& material : kMaterials) {
    const Eigen::Matrix3d f = Eigen::Matrix3d::Identity() + numbers.matrix(0.2);
    const Eigen::Matrix3d c = f.transpose() * f, frame = numbers.rotation();
    const Tensor6 once = response_of(material, c, frame).stress;
    EXPECT_LT((response_of(scaled(material, 3), c, frame).stress - 3 * once).norm(), 1e-12 * once.norm());
  }
}

TEST(MechanicsMaterial, NeoHookeanInSimpleShearHasItsShearModulus) {
  // F = I + g e_x e_y^T keeps the volume; the Cauchy stress xy is 2 c1 g.
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  f(0, 1) = 0.3;
  const Response at = response_of(MooneyRivlin{1.5, 0}, f.transpose() * f, Eigen::Matrix3d::Identity());
  EXPECT_NEAR((f * matrix_of(at.stress) * f.transpose())(0, 1), 2 * 1.5 * 0.3, 1e-12);
}

TEST(MechanicsMaterial, CorotationalStressIsLinearInTheStretchAndTurnsWithTheBody) {
  // With P = F S, the symmetric part of R^T P is the derivative of the energy by U.
  Numbers numbers;
  const Corotational material{1.5, 2.5, 7};
  const Eigen::Matrix3d frame = numbers.rotation();
  for (int trial = 0; trial < 10; ++trial) {
    const Eigen::Matrix3d turn = numbers.rotation(), part = numbers.matrix(0.1);
    const Eigen::Matrix3d e = part + part.transpose();
    const auto first_piola = [&](double size) {
      const Eigen::Matrix3d f = turn * (Eigen::Matrix3d::Identity() + size * e);
      return Eigen::Matrix3d(f * matrix_of(response_of(material, f.transpose() * f, frame).stress));
    };
    const auto biot = [&](double size) {
      const Eigen::Matrix3d p = turn.transpose() * first_piola(size);
      return Eigen::Matrix3d((p + p.transpose()) / 2);
    };
    const Eigen::Matrix3d local =
        frame.transpose() * (e - e.trace() / 3 * Eigen::Matrix3d::Identity()) * frame;
    const Eigen::Matrix3d found = frame.transpose() * biot(1) * frame;
    EXPECT_NEAR(found(0, 1), 2 * 2.5 * local(0, 1), 1e-12);
    EXPECT_NEAR(found(1, 2), 2 * 1.5 * local(1, 2), 1e-12);
    EXPECT_NEAR(found(0, 0), (2 * 1.5 + 7 * 2.0 / 3) * local(0, 0), 1e-12);
    EXPECT_LT((biot(1) - 2 * biot(0.5)).norm(), 1e-12);
  }
}

TEST(MechanicsMaterial, CorotationalIsTransverselyIsotropicAtSmallStretch) {
  constexpr double kSmall = 1e-6;
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  f(0, 0) += kSmall;
  f(1, 1) -= kSmall / 2;
  f(2, 2) -= kSmall / 2;
  f(0, 1) += 0.3 * kSmall;
  const Eigen::Matrix3d c = f.transpose() * f, frame = Eigen::Matrix3d::Identity();
  const Tensor6 linear = response_of(Corotational{}, c, frame).stress;
  const Tensor6 other = response_of(TransverselyIsotropic{}, c, frame).stress;
  const double mean = (linear - other).head<3>().sum() / 3;  // of pressure, which is not the material's
  EXPECT_LT((linear - other - mean * tensor6(frame)).norm(), 1e-5 * linear.norm());
}

TEST(MechanicsMaterial, ParametersOutOfRangeAreNamed) {
  EXPECT_EQ(fault_of(Guccione{}), std::nullopt);
  EXPECT_EQ(fault_of(Guccione{2, 0, 2, 4}).value(), "b_f: found 0, expected a finite number above 0");
  EXPECT_EQ(fault_of(MooneyRivlin{-1, 0}).value(),
            "c1_kpa: found -1, expected a finite number not below 0 kPa");
}

TEST(PortableExp, IsTheExponentialAndTheLogarithm) {
  Numbers numbers;
  for (int i = 0; i < 1000; ++i) {
    const double x = numbers.next(50);
    EXPECT_NEAR(portable_exp(x) / std::exp(x), 1, 1e-15) << x;
    EXPECT_NEAR(portable_log(std::exp(x)), x, 2e-15 * std::max(1.0, std::abs(x))) << x;
  }
  EXPECT_EQ(portable_exp(0), 1);
  EXPECT_EQ(portable_log(1), 0);
  EXPECT_EQ(portable_exp(-1e300), 0);
  EXPECT_TRUE(std::isinf(portable_exp(1e300)));
  EXPECT_TRUE(std::isnan(portable_exp(std::nan(""))));
}

}  // namespace
}  // namespace voxtet::mechanics
