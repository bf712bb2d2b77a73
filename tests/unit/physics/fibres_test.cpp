#include "physics/ventricles/ventricular_fibres.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "base/digest.h"
#include "geometry/elements/surface_measures.h"
#include "support/ellipsoid.h"

namespace voxtet {
namespace {

constexpr double kRadians = EIGEN_PI / 180;

VentricularPotentials potentials_of(const test::HeartBody& body) {
  auto potentials = ventricular_potentials(body.mesh, body.surfaces, {});
  EXPECT_TRUE(potentials.ok()) << (potentials.ok() ? "" : potentials.error().message);
  return *std::move(potentials);
}

Fibres fibres_of(const test::HeartBody& body, const FibreParams& params) {
  auto fibres = tet_fibres(body.mesh, body.surfaces, potentials_of(body), params, {});
  EXPECT_TRUE(fibres.ok()) << (fibres.ok() ? "" : fibres.error().message);
  return *std::move(fibres);
}

/// Degrees, of directions whose signs mean nothing.
double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b))) / kRadians;
}

struct Errors {
  double mean = 0, p95 = 0;
  double left_out = 0;  ///< share of the tetrahedra
};

/// Rule linear with angles of 60 and -60 against the closed form, at the centroids of the tetrahedra above
/// the first tenth of the way from apex to base.
Errors errors_in_ellipsoid(std::uint32_t layers, std::uint32_t rings) {
  const test::Ellipsoid ellipsoid;
  const test::HeartBody body = test::left_ventricle(layers, rings);
  const Fibres fibres = fibres_of(body, {});
  std::vector<double> angles;
  for (std::size_t t = 0; t < body.mesh.tets.size(); ++t) {
    double part = 0;
    for (const std::uint32_t i : body.mesh.tets[t]) part += body.part[i] / 4;
    if (part < 0.1) continue;
    const Eigen::Vector3d centroid = body.centroid(t);
    const double alpha = (60 - 120 * ellipsoid.depth(centroid)) * kRadians;
    angles.push_back(angle_between(ellipsoid.fibre(centroid, alpha), fibres.fibre[t]));
  }
  std::sort(angles.begin(), angles.end());
  const auto count = static_cast<double>(angles.size());
  return {std::accumulate(angles.begin(), angles.end(), 0.0) / count, angles[angles.size() * 95 / 100],
          1 - count / static_cast<double>(body.mesh.tets.size())};
}

TEST(Fibres, LinearRuleIsTheClosedFormInAnEllipsoid) {
  const Errors two = errors_in_ellipsoid(2, 12), four = errors_in_ellipsoid(4, 24),
               eight = errors_in_ellipsoid(8, 24);
  EXPECT_LT(four.left_out, 0.01);
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

/// The helix angle (degrees, -90 to 90) about z of a direction in a surface with this outward normal.
double helix_angle(const Eigen::Vector3d& fibre, const Eigen::Vector3d& outward) {
  const Eigen::Vector3d t = outward.normalized();
  const Eigen::Vector3d l = (Eigen::Vector3d::UnitZ() - t.z() * t).normalized(), c = l.cross(t);
  return std::atan(fibre.dot(l) / fibre.dot(c)) / kRadians;
}

/// The mean helix angle of the tetrahedra at the faces of a surface, away from its rim and the apex; `side`
/// is 1 where face normals point outwards of the ventricle that the angle is about, -1 where they point
/// inwards.
double mean_helix_angle(const test::HeartBody& body, const Fibres& fibres, HeartSurface surface, double side,
                        double least_x, double most_x) {
  std::vector<bool> at(body.mesh.points.size(), false), rim = at;
  std::vector<Eigen::Vector3d> normal(at.size(), Eigen::Vector3d::Zero());
  for (std::size_t f = 0; f < body.mesh.faces.size(); ++f)
    for (const std::uint32_t i : body.mesh.faces[f]) {
      if (body.surfaces.faces[f] == surface) {
        const auto& [a, b, c] = body.mesh.faces[f];
        normal[i] += side * triangle_cross(body.mesh.points[a], body.mesh.points[b], body.mesh.points[c]);
        at[i] = true;
      } else {
        rim[i] = true;
      }
    }
  double sum = 0;
  int count = 0;
  for (std::size_t t = 0; t < body.mesh.tets.size(); ++t) {
    int here = 0;
    Eigen::Vector3d outward = Eigen::Vector3d::Zero();
    for (const std::uint32_t i : body.mesh.tets[t]) {
      here += at[i] && !rim[i] && body.part[i] > 0.5 && body.part[i] < 0.9;
      outward += normal[i];
    }
    const double x = body.centroid(t).x();
    if (here < 3 || x < least_x || x > most_x) continue;
    sum += helix_angle(fibres.fibre[t], outward);
    ++count;
  }
  EXPECT_GT(count, 10);
  return sum / count;
}

/// Mean helix angles at the surfaces. On the septum as seen from the left ventricle.
struct HelixAngles {
  double lv, septum_left, septum_right, rv, lv_epi, rv_epi;

  HelixAngles(const test::HeartBody& body, const FibreParams& params) {
    constexpr double kFar = 100;
    const Fibres fibres = fibres_of(body, params);
    const auto mean = [&](HeartSurface surface, double side, double least_x, double most_x) {
      return mean_helix_angle(body, fibres, surface, side, least_x, most_x);
    };
    lv = mean(HeartSurface::kLvEndocardium, -1, -kFar, 0);
    septum_left = mean(HeartSurface::kLvEndocardium, -1, 5, kFar);
    septum_right = mean(HeartSurface::kRvSeptum, 1, 5, kFar);
    rv = mean(HeartSurface::kRvEndocardium, -1, 5, kFar);
    lv_epi = mean(HeartSurface::kEpicardium, 1, -kFar, 0);
    rv_epi = mean(HeartSurface::kEpicardium, 1, 16, kFar);
  }
};

// Centroids are a quarter of a layer from the surface, 1/16 of the wall.
constexpr double kDepth = 1 / 16.0;

TEST(Fibres, AreRightHandedHelicesAtBothEndocardiaAndLeftHandedOnesAtTheEpicardium) {
  const HelixAngles found(test::two_ventricles(4, 24), {});
  const double angle = 60 - 120 * kDepth;
  EXPECT_NEAR(found.lv, angle, 1);
  EXPECT_NEAR(found.septum_left, angle, 1);
  EXPECT_NEAR(found.septum_right, -angle, 1);
  EXPECT_NEAR(found.rv, angle, 1);
  EXPECT_NEAR(found.lv_epi, -angle, 1);
  EXPECT_NEAR(found.rv_epi, -angle, 1);
}

TEST(Fibres, SoTheyAreByBayersRule) {
  const HelixAngles found(test::two_ventricles(4, 24), {FibreRule::kBayer, {}, {}});
  // Of a blend by phi between 60 and 60 - 120 phi, the shorter way round.
  const double endo = 60 - 120 * kDepth * kDepth;
  const double epi = 60 + (1 - kDepth) * (180 - 120 * (1 - kDepth)) - 180;
  const double septum = 60 - 120 * kDepth;
  EXPECT_NEAR(found.lv, endo, 2);
  EXPECT_NEAR(found.septum_left, septum, 2);
  EXPECT_NEAR(found.septum_right, -septum, 2);
  EXPECT_NEAR(found.rv, endo, 2);
  EXPECT_NEAR(found.lv_epi, epi, 2);
  EXPECT_NEAR(found.rv_epi, epi, 2);
}

TEST(Fibres, TheSeptumMayHaveItsOwnAngles) {
  for (const FibreRule rule : {FibreRule::kLinear, FibreRule::kBayer}) {
    const HelixAngles found(test::two_ventricles(4, 24), {rule, {}, FibreAngles{20, -30, 0, 0}});
    EXPECT_NEAR(found.lv, rule == FibreRule::kLinear ? 60 - 120 * kDepth : 60 - 120 * kDepth * kDepth, 2);
    EXPECT_NEAR(found.septum_left, 20 - 50 * kDepth, 1);
    EXPECT_NEAR(found.septum_right, -30 + 50 * kDepth, 1);
    EXPECT_NEAR(found.rv, rule == FibreRule::kLinear ? 60 - 120 * kDepth : 60 - 120 * kDepth * kDepth, 2);
  }
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
  EXPECT_EQ(sha.hex(), "32a9a029ff96e5ad6dc81f70b0d159eae1e67895f3a7ced72a867b9f6b516f61");
}

}  // namespace
}  // namespace voxtet
