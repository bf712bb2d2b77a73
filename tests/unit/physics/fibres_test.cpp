#include "physics/ventricles/ventricular_fibres.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "base/digest.h"
#include "support/heart_fibres.h"

namespace voxtet {
namespace {

using test::angle_between, test::fibres_of, test::kRadians, test::potentials_of;

struct Errors {
  double mean = 0, p95 = 0;  ///< degrees
};

/// Rule linear with angles of 60 and -60 against the closed form, at the centroids of all tetrahedra; those
/// at the apex too, where the closed form turns once around within an element.
Errors errors_in_ellipsoid(std::uint32_t layers, std::uint32_t rings) {
  const test::Ellipsoid ellipsoid;
  const test::HeartBody body = test::left_ventricle(layers, rings);
  const Fibres fibres = fibres_of(body, {});
  std::vector<double> angles;
  for (std::size_t t = 0; t < body.mesh.tets.size(); ++t) {
    const Eigen::Vector3d centroid = body.centroid(t);
    const double alpha = (60 - 120 * ellipsoid.depth(centroid)) * kRadians;
    angles.push_back(angle_between(ellipsoid.fibre(centroid, alpha), fibres.fibre[t]));
  }
  std::sort(angles.begin(), angles.end());
  return {std::accumulate(angles.begin(), angles.end(), 0.0) / static_cast<double>(angles.size()),
          angles[angles.size() * 95 / 100]};
}

TEST(Fibres, LinearRuleIsTheClosedFormInAnEllipsoid) {
  const Errors two = errors_in_ellipsoid(2, 12), four = errors_in_ellipsoid(4, 24),
               eight = errors_in_ellipsoid(8, 24);
  EXPECT_LT(four.mean, 3);
  EXPECT_LT(four.p95, 8);
  EXPECT_LT(four.mean, two.mean / 2);
  EXPECT_LT(four.p95, two.p95 / 2);
  // What is left is the difference between the shortest way through the wall and the curve of constant u and
  // v.
  EXPECT_LT(eight.mean, 0.5);
  EXPECT_LT(eight.p95, 1.5);
}

TEST(Fibres, BayersRuleIsItsFormulaInASingleVentricle) {
  const test::HeartBody body = test::left_ventricle(3, 14);
  const VentricularPotentials potentials = potentials_of(body);
  const FibreAngles angles{60, -60, 0, 0};
  const Fibres fibres =
      tet_fibres(body.mesh, body.surfaces, potentials, {FibreRule::kBayer, angles, {}}, {}).value();
  std::size_t turned_back = 0;
  for (std::size_t t = 0; t < body.mesh.tets.size(); ++t) {
    double phi = 0, part = 0;
    for (const std::uint32_t i : body.mesh.tets[t]) {
      phi += potentials.epi[i] / 4;
      part += body.part[i] / 4;
    }
    if (part < 0.4) continue;
    // From alpha = 60 on the endocardial frame by phi towards 60 - 120 phi, the shorter way round: beyond a
    // quarter turn the published rule goes the other way.
    const double way = -120 * phi + (phi > 0.75 ? 180 : 0);
    turned_back += phi > 0.75;
    const double alpha = (60 + phi * way) * kRadians;
    const Eigen::Vector3d exact = test::Ellipsoid().fibre(body.centroid(t), alpha);
    EXPECT_LT(angle_between(exact, fibres.fibre[t]), 5) << phi;
  }
  EXPECT_GT(turned_back, 100U);
}

TEST(Fibres, SheetsStandAtBetaFromTheOutwardDirection) {
  const test::HeartBody body = test::left_ventricle(2, 10);
  const test::Ellipsoid ellipsoid;
  for (const double beta : {0.0, 30.0}) {
    const Fibres fibres = fibres_of(body, {FibreRule::kLinear, {0, 0, beta, beta}, {}});
    for (std::size_t t = 0; t < body.mesh.tets.size(); ++t) {
      const Eigen::Vector3d p = body.centroid(t);
      if (p.z() < -12) continue;
      // Without a helix the sheet leans to the base.
      const Eigen::Vector3d along = ellipsoid.fibre(p, EIGEN_PI / 2), around = ellipsoid.fibre(p, 0);
      const Eigen::Vector3d outward = around.cross(along);
      const Eigen::Vector3d sheet = std::sin(beta * kRadians) * along + std::cos(beta * kRadians) * outward;
      EXPECT_LT(angle_between(fibres.sheet[t], sheet), 5);
      EXPECT_LT(angle_between(fibres.fibre[t], around), 5);
    }
  }
}

void expect_orthonormal(const Fibres& fibres, std::size_t count) {
  ASSERT_EQ(fibres.fibre.size(), count);
  ASSERT_EQ(fibres.sheet.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_NEAR(fibres.fibre[i].norm(), 1, 1e-12);
    EXPECT_NEAR(fibres.sheet[i].norm(), 1, 1e-12);
    EXPECT_NEAR(fibres.fibre[i].dot(fibres.sheet[i]), 0, 1e-12);
  }
}

TEST(Fibres, AreUnitVectorsAtRightAnglesToSheetsEverywhere) {
  for (const test::HeartBody& body : {test::left_ventricle(1, 5), test::two_ventricles(2, 12)})
    for (const FibreRule rule : {FibreRule::kLinear, FibreRule::kBayer}) {
      const Fibres of_tets = fibres_of(body, {rule, {}, {}});
      expect_orthonormal(of_tets, body.mesh.tets.size());
      expect_orthonormal(point_fibres(body.mesh, of_tets), body.mesh.points.size());
    }
}

TEST(Fibres, ThereIsAFrameWherePotentialsAreFlat) {
  const test::HeartBody body = test::left_ventricle(1, 3);
  VentricularPotentials flat = potentials_of(body);
  for (Eigen::VectorXd* u : {&flat.epi, &flat.lv, &flat.rv, &flat.base}) u->setZero();
  for (const FibreRule rule : {FibreRule::kLinear, FibreRule::kBayer})
    expect_orthonormal(tet_fibres(body.mesh, body.surfaces, flat, {rule, {}, {}}, {}).value(),
                       body.mesh.tets.size());
}

TEST(Fibres, AtPointsAreThoseOfTheTetrahedraAroundThemWhateverTheirSigns) {
  const test::HeartBody body = test::left_ventricle(4, 16);
  Fibres of_tets = fibres_of(body, {});
  const Fibres of_points = point_fibres(body.mesh, of_tets);
  const test::Ellipsoid ellipsoid;
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < body.mesh.points.size(); ++i) {
    if (body.part[i] < 0.1 || body.depth[i] == 0 || body.depth[i] == 1) continue;
    const double alpha = (60 - 120 * body.depth[i]) * kRadians;
    sum += angle_between(of_points.fibre[i], ellipsoid.fibre(body.mesh.points[i], alpha));
    ++count;
  }
  EXPECT_LT(sum / count, 2);

  for (std::size_t t = 0; t < body.mesh.tets.size(); t += 3) {
    of_tets.fibre[t] *= -1;
    of_tets.sheet[t] *= -1;
  }
  EXPECT_EQ(point_fibres(body.mesh, of_tets).fibre, of_points.fibre);
}

TEST(Fibres, AreZeroOutsideOfTheWall) {
  test::HeartBody body = test::left_ventricle(2, 6);
  body.surfaces.wall.back() = false;
  const Fibres of_tets = fibres_of(body, {});
  EXPECT_TRUE(of_tets.fibre.back().isZero(0));
  EXPECT_TRUE(of_tets.sheet.back().isZero(0));
}

TEST(Fibres, NameTheAngleOrPresetThatIsWrong) {
  const test::HeartBody body = test::left_ventricle(1, 3);
  const VentricularPotentials potentials = potentials_of(body);
  const auto message = [&](const FibreParams& params) {
    const auto fibres = tet_fibres(body.mesh, body.surfaces, potentials, params, {});
    if (fibres.ok()) return std::string("none");
    EXPECT_EQ(fibres.error().code, ErrorCode::kUsage);
    return fibres.error().message;
  };
  FibreParams params;
  params.wall.beta_epi = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message(params), "physics.fibres.wall.beta_epi: found nan, expected from -180 to 180 degrees");
  params = {};
  params.septum = FibreAngles{181, 0, 0, 0};
  EXPECT_EQ(message(params),
            "physics.fibres.septum.alpha_endo: found 181, expected from -180 to 180 degrees");

  EXPECT_EQ(fibre_angles("strocchi")->alpha_endo, 80);
  EXPECT_EQ(fibre_angles("bayer")->alpha_epi, -50);
  EXPECT_EQ(fibre_angles("kit")->beta_endo, -45);
  EXPECT_EQ(fibre_angles("cemrg")->alpha_endo, FibreAngles().alpha_endo);
  const auto unknown = fibre_angles("streeter");
  ASSERT_FALSE(unknown.ok());
  EXPECT_EQ(unknown.error().code, ErrorCode::kUsage);
  EXPECT_EQ(unknown.error().message,
            "physics.fibres.preset: found \"streeter\", expected one of bayer, cemrg, strocchi, kit");
}

TEST(Fibres, StopWhenCancelled) {
  const test::HeartBody body = test::left_ventricle(1, 3);
  const VentricularPotentials potentials = potentials_of(body);
  RunContext ctx;
  ctx.on_cancelled = [] { return true; };
  const auto fibres = tet_fibres(body.mesh, body.surfaces, potentials, {}, ctx);
  ASSERT_FALSE(fibres.ok());
  EXPECT_EQ(fibres.error().code, ErrorCode::kCancelled);
}

TEST(Fibres, SameBytesForAnyNumberOfThreads) {
  const test::HeartBody body = test::two_ventricles(1, 8);
  const VentricularPotentials potentials = potentials_of(body);
  RunContext ctx;
  const Fibres one = tet_fibres(body.mesh, body.surfaces, potentials, {}, ctx).value();
  ctx.threads = 3;
  EXPECT_EQ(tet_fibres(body.mesh, body.surfaces, potentials, {}, ctx)->fibre, one.fibre);
}

TEST(Fibres, SameBytesOnEveryPlatform) {
  const test::HeartBody body = test::two_ventricles(1, 8);
  Sha256 sha;
  const auto update = [&](const Fibres& fibres) {
    for (const auto* directions : {&fibres.fibre, &fibres.sheet})
      for (const Eigen::Vector3d& direction : *directions) sha.update_values(direction.data(), 3);
  };
  for (const FibreRule rule : {FibreRule::kLinear, FibreRule::kBayer}) {
    const Fibres of_tets = fibres_of(body, {rule, {}, {}});
    update(of_tets);
    update(point_fibres(body.mesh, of_tets));
  }
  EXPECT_EQ(sha.hex(), "b443be916072637a4061e76c69ea3527a9cb036387f4c1689dfed9dae897c77e");
}

}  // namespace
}  // namespace voxtet
