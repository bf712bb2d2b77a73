// An elastic body's forces, tangents and balance.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>

#include "physics/mechanics/loads/surface.h"
#include "physics/mechanics/solve/load_steps.h"
#include "support/bricks.h"
#include "support/land.h"
#include "support/test_random.h"

namespace voxtet::mechanics {
namespace {

constexpr Formulation kFormulations[] = {Formulation::kLinear, Formulation::kAverageNodalPressure,
                                         Formulation::kQuadratic, Formulation::kStabilised};

TetMesh box() {
  return test::bricks({2, 1.5, 1}, {2, 2, 2});
}

Body body_of(const TetMesh& mesh, Formulation formulation, const Material& material = HolzapfelOgden{}) {
  Muscle muscle;
  muscle.materials = {material};
  muscle.bulk_kpa = 30;
  muscle.viscosity_kpa_s = 0.7;
  return Body::make(mesh, formulation, std::move(muscle)).value();
}

/// Displacements of at most so many mm, and pressures of so many times 200 kPa.
Eigen::VectorXd random_state(const Body& body, double most, std::uint64_t seed) {
  test::TestRandom random(seed);
  Eigen::VectorXd u(body.unknowns());
  for (double& x : u) x = most * (random.below(2001) - 1000) / 1000;
  u.tail(body.unknowns() - body.displacements()) *= 200;
  return u;
}

Eigen::VectorXd forces(const Body& body, const Eigen::VectorXd& u, std::span<const double> tension,
                       const StrainRate* rate = nullptr) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(u.size());
  EXPECT_TRUE(body.add_forces(u, tension, force, nullptr, rate));
  return force;
}

TEST(MechanicsBody, ForcesAreTheDerivativeOfTheEnergy) {
  constexpr double kStep = 1e-5;
  const TetMesh mesh = box();
  for (const Formulation formulation : kFormulations) {
    const Body body = body_of(mesh, formulation);
    const Eigen::VectorXd u = random_state(body, 0.05, 7);
    const Eigen::VectorXd force = forces(body, u, {});
    for (Eigen::Index i = 0; i < u.size(); i += 5) {
      const Eigen::VectorXd h = kStep * Eigen::VectorXd::Unit(u.size(), i);
      const double slope = (*body.energy(u + h) - *body.energy(u - h)) / (2 * kStep);
      EXPECT_NEAR(slope, force[i], 1e-7 * force.norm());
    }
  }
}

TEST(MechanicsBody, TangentIsTheDerivativeOfTheForces) {
  constexpr double kStep = 1e-6;
  const TetMesh mesh = box();
  const std::vector<double> tension(mesh.tets.size(), 3.0);
  for (const Formulation formulation : kFormulations) {
    const Body body = body_of(mesh, formulation);
    const Eigen::VectorXd u = random_state(body, 0.05, 8);
    const Eigen::VectorXd before = random_state(body, 0.05, 11);
    const StrainRate rate{before, 0.02};
    fem::SparseMatrix tangent = body.empty_tangent();
    Eigen::VectorXd force = Eigen::VectorXd::Zero(u.size());
    ASSERT_TRUE(body.add_forces(u, tension, force, &tangent, &rate));
    const Eigen::MatrixXd dense = tangent;
    for (Eigen::Index i = 0; i < u.size(); i += 3) {
      const Eigen::VectorXd h = kStep * Eigen::VectorXd::Unit(u.size(), i);
      const Eigen::VectorXd slope =
          (forces(body, u + h, tension, &rate) - forces(body, u - h, tension, &rate)) / (2 * kStep);
      EXPECT_LT((slope - dense.col(i)).norm(), 1e-7 * dense.col(i).norm());
    }
    EXPECT_LT((dense - dense.transpose()).norm(), 1e-12 * dense.norm());
  }
}

TEST(MechanicsBody, ViscosityResistsTheRateOfStrain) {
  // A block stretched along x from 1 to l in a step: E_xx has grown by (l^2 - 1) / 2, and the force on its
  // end of area A is that of P = l S.
  const TetMesh mesh = test::bricks({2, 1, 1}, {2, 1, 1});
  constexpr double kStretch = 1.2, kViscosity = 0.7, kStep = 0.02, kArea = 1;
  for (const Formulation formulation : kFormulations) {
    const Body body = body_of(mesh, formulation);
    const auto& places = body.nodes().places();
    const Eigen::VectorXd before = Eigen::VectorXd::Zero(body.unknowns());
    Eigen::VectorXd u = before;
    for (std::size_t i = 0; i < places.size(); ++i)
      u[3 * static_cast<Eigen::Index>(i)] = (kStretch - 1) * places[i].x();
    const StrainRate rate{before, kStep};
    const Eigen::VectorXd viscous = forces(body, u, {}, &rate) - forces(body, u, {});
    double pull = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
      if (places[i].x() == 2) pull += viscous[3 * static_cast<Eigen::Index>(i)];
    EXPECT_NEAR(pull, kArea * kStretch * kViscosity * (kStretch * kStretch - 1) / 2 / kStep, 1e-11);
    const StrainRate still{u, kStep};
    EXPECT_EQ(forces(body, u, {}, &still), forces(body, u, {}));
  }
}

TEST(MechanicsBody, PressureOnAClosedSurfaceIsTheGradientOfItsVolume) {
  constexpr double kStep = 1e-5;
  const TetMesh mesh = box();
  for (const Formulation formulation : {Formulation::kLinear, Formulation::kQuadratic}) {
    const Body body = body_of(mesh, formulation);
    const Nodes& nodes = body.nodes();
    const Surface surface(nodes, mesh.faces);
    EXPECT_NEAR(surface.volume_mm3(nodes.places_after({})), 3, 1e-12);
    const Eigen::VectorXd x = nodes.places_after(random_state(body, 0.1, 9));
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(x.size());
    surface.add_area_vectors(x, 1, gradient);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const Eigen::VectorXd h = kStep * Eigen::VectorXd::Unit(x.size(), i);
      const double slope = (surface.volume_mm3(x + h) - surface.volume_mm3(x - h)) / (2 * kStep);
      EXPECT_NEAR(slope, gradient[i], 1e-6 * gradient.norm());
    }
    Eigen::VectorXd moved = x;
    for (Eigen::Index i = 0; i < x.size(); ++i) moved[i] += i % 3 + 1;
    EXPECT_NEAR(surface.volume_mm3(moved), surface.volume_mm3(x), 1e-11);
  }
}

TEST(MechanicsBody, TangentOfAPressureIsTheDerivativeOfItsForce) {
  constexpr double kStep = 1e-5;
  const TetMesh mesh = box();
  const auto side = test::faces_where(mesh, [&](std::uint32_t i) { return mesh.points[i].x() == 2; });
  for (const Formulation formulation : {Formulation::kLinear, Formulation::kQuadratic}) {
    const Body body = body_of(mesh, formulation);
    const Nodes& nodes = body.nodes();
    const Eigen::VectorXd x = nodes.places_after(random_state(body, 0.1, 10));
    for (const auto& faces : {mesh.faces, side}) {
      const Surface surface(nodes, faces);
      fem::SparseMatrix tangent = body.empty_tangent();
      surface.add_area_tangent(x, 2.5, tangent);
      const Eigen::MatrixXd dense = tangent;
      const auto force = [&](const Eigen::VectorXd& at) {
        Eigen::VectorXd out = Eigen::VectorXd::Zero(x.size());
        surface.add_area_vectors(at, 2.5, out);
        return out;
      };
      for (Eigen::Index i = 0; i < x.size(); ++i) {
        const Eigen::VectorXd h = kStep * Eigen::VectorXd::Unit(x.size(), i);
        EXPECT_LT(((force(x + h) - force(x - h)) / (2 * kStep) - dense.col(i)).norm(), 1e-8 * dense.norm());
      }
      const bool closed = faces.size() == mesh.faces.size();
      EXPECT_EQ((dense - dense.transpose()).norm() < 1e-12 * dense.norm(), closed);
    }
  }
}

TEST(MechanicsBody, EveryElementReproducesAnAffineDeformation) {
  // The patch test: the surface is held in an affine deformation, the inside starts elsewhere.
  const TetMesh mesh = box();
  Eigen::Matrix3d slope;
  slope << 0.05, 0.08, -0.03, 0.02, -0.04, 0.06, 0.01, 0.03, 0.07;
  for (const Formulation formulation : kFormulations) {
    const Body body = body_of(mesh, formulation, TransverselyIsotropic{});
    const auto& places = body.nodes().places();
    std::vector<bool> held = test::held_where(body.nodes(), [](const Eigen::Vector3d& p) {
      return p.x() == 0 || p.x() == 2 || p.y() == 0 || p.y() == 1.5 || p.z() == 0 || p.z() == 1;
    });
    held.resize(static_cast<std::size_t>(body.unknowns()));
    Eigen::VectorXd affine = Eigen::VectorXd::Zero(body.unknowns());
    for (std::size_t i = 0; i < places.size(); ++i)
      affine.segment<3>(3 * static_cast<Eigen::Index>(i)) = slope * places[i];
    Eigen::VectorXd start = affine;
    for (Eigen::Index i = 0; i < body.displacements(); ++i)
      if (!held[static_cast<std::size_t>(i)]) start[i] += 0.02;
    EXPECT_GT((start - affine).norm(), 0.03);
    auto solve = LoadSteps::start(body, {}, held, {.steps = 1, .tolerance = 1e-11}, start).value();
    const auto done = solve.advance();
    ASSERT_TRUE(done) << done.error().message;
    const Eigen::Index count = body.displacements();
    EXPECT_LT((solve.displacement().head(count) - affine.head(count)).norm(), 1e-9);
    const double j = (Eigen::Matrix3d::Identity() + slope).determinant();
    for (const double pressure : body.node_pressures_kpa(solve.displacement()))
      EXPECT_NEAR(pressure, volumetric(30, j).pressure_kpa, 1e-9);
  }
}

TEST(MechanicsBody, ABarUnderTensionShortensAsItsClosedFormSays) {
  // A free bar of a neo-Hookean material with fibres along x and the tension T: with stretches l, m, m the
  // stress vanishes, along the fibre S_iso + p J / l^2 + T and across it S_iso + p J / m^2.
  const TetMesh mesh = test::bricks({2, 1, 1}, {2, 1, 1});
  constexpr double kC1 = 2, kBulk = 30, kTension = 1.5;
  double l = 1, m = 1;
  const auto stress = [&](double along, double across) {
    const double j = along * across * across, s = std::pow(j, -2.0 / 3);
    const double i1 = along * along + 2 * across * across, p = kBulk / 2 * (j - 1 / j);
    return Eigen::Vector2d(2 * kC1 * s * (1 - i1 / 3 / (along * along)) + p * j / (along * along) + kTension,
                           2 * kC1 * s * (1 - i1 / 3 / (across * across)) + p * j / (across * across));
  };
  for (int i = 0; i < 50; ++i) {
    constexpr double kStep = 1e-6;
    Eigen::Matrix2d slope;
    slope.col(0) = (stress(l + kStep, m) - stress(l - kStep, m)) / (2 * kStep);
    slope.col(1) = (stress(l, m + kStep) - stress(l, m - kStep)) / (2 * kStep);
    const Eigen::Vector2d change = slope.inverse() * stress(l, m);
    l -= change[0];
    m -= change[1];
  }
  ASSERT_LT(stress(l, m).norm(), 1e-12);
  ASSERT_LT(l, 0.95);
  for (const Formulation formulation : kFormulations) {
    const Body body = body_of(mesh, formulation, MooneyRivlin{kC1, 0});
    const auto& places = body.nodes().places();
    std::vector<bool> held;
    for (const Eigen::Vector3d& p : places)
      for (int d = 0; d < 3; ++d) held.push_back(p[d] == 0);
    auto solved = test::solve_all(body, {{}, {}, std::vector<double>(mesh.tets.size(), kTension)}, held,
                                  {.steps = 2, .tolerance = 1e-10});
    ASSERT_TRUE(solved) << solved.error().message;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Eigen::Vector3d x = places[i] + solved->u.segment<3>(3 * static_cast<Eigen::Index>(i));
      EXPECT_LT((x - Eigen::Vector3d(l, m, m).cwiseProduct(places[i])).norm(), 1e-8);
    }
  }
}

TEST(MechanicsBody, SpringsGiveWayByPressureOverStiffness) {
  // All nodes slide along x alone: a pressure on one end pushes the other one against its springs.
  const TetMesh mesh = box();
  constexpr double kPressure = 0.6, kStiffness = 3;
  const auto end_at = [&](double x) {
    return test::faces_where(mesh, [&, x](std::uint32_t i) { return mesh.points[i].x() == x; });
  };
  for (const Formulation formulation : kFormulations) {
    const Body body = body_of(mesh, formulation, TransverselyIsotropic{});
    const auto& places = body.nodes().places();
    std::vector<bool> held;
    for (std::size_t i = 0; i < places.size(); ++i) held.insert(held.end(), {false, true, true});
    const Surface pushed(body.nodes(), end_at(2)), springy(body.nodes(), end_at(0));
    const auto solved =
        test::solve_all(body, {{{pushed, kPressure}}, {{springy, kStiffness, 100}}, {}}, held, {.steps = 2});
    ASSERT_TRUE(solved) << solved.error().message;
    for (std::size_t i = 0; i < places.size(); ++i)
      if (places[i].x() == 0) {
        EXPECT_NEAR(solved->u[3 * static_cast<Eigen::Index>(i)], -kPressure / kStiffness, 1e-6);
      }
  }
}

TEST(MechanicsBody, WhatCannotBeBalancedSaysWhereAndKeepsTheLastState) {
  // A soft block, clamped at one end, under a pressure that it cannot bear.
  const TetMesh mesh = box();
  const Body body = body_of(mesh, Formulation::kLinear, MooneyRivlin{1e-3, 0});
  const auto held = test::held_where(body.nodes(), [](const Eigen::Vector3d& p) { return p.x() == 0; });
  const auto top = test::faces_where(mesh, [&](std::uint32_t i) { return mesh.points[i].z() == 1; });
  auto solve = LoadSteps::start(body, {{{Surface(body.nodes(), top), 1e3}}, {}, {}}, held,
                                {.steps = 2, .most_iterations = 6, .most_halvings = 2})
                   .value();
  Result<bool> done = solve.advance();
  for (int i = 0; i < 20 && done && !*done; ++i) done = solve.advance();
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::kMeshing);
  EXPECT_EQ(done.error().message.substr(0, 15), "no balance with");
  EXPECT_LT(solve.load(), 1);
  EXPECT_TRUE(solve.displacement().allFinite());
  Eigen::VectorXd force = Eigen::VectorXd::Zero(body.unknowns());
  EXPECT_TRUE(body.add_forces(solve.displacement(), {}, force, nullptr));
}

TEST(MechanicsBody, AnInvertedTetrahedronIsNamedWithItsPlace) {
  const TetMesh mesh = box();
  const Body body = body_of(mesh, Formulation::kLinear);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(body.unknowns());
  u[0] = 5;
  Eigen::VectorXd force = Eigen::VectorXd::Zero(body.unknowns());
  const Status done = body.add_forces(u, {}, force, nullptr);
  ASSERT_FALSE(done);
  EXPECT_NE(done.error().message.find("is inverted"), std::string::npos);
  EXPECT_EQ(done.error().where.points.size(), 1U);
}

TEST(MechanicsBody, WrongListsAndMaterialsAreRefused) {
  const TetMesh mesh = box();
  Muscle muscle;
  muscle.bulk_kpa = 0;
  EXPECT_EQ(Body::make(mesh, Formulation::kLinear, muscle).error().code, ErrorCode::kUsage);
  muscle = {};
  muscle.viscosity_kpa_s = -1;
  EXPECT_EQ(Body::make(mesh, Formulation::kLinear, muscle).error().code, ErrorCode::kUsage);
  muscle = {};
  muscle.material = {0};
  EXPECT_EQ(Body::make(mesh, Formulation::kLinear, muscle).error().message,
            "material: found 1 entries, expected 48");
  muscle = {};
  muscle.frames.resize(48);
  EXPECT_TRUE(Body::make(mesh, Formulation::kLinear, muscle));
  EXPECT_EQ(Body::make(mesh, Formulation::kQuadratic, muscle).error().message,
            "frames: found 48 entries, expected 192");
  muscle = {};
  muscle.materials = {MooneyRivlin{0, 0}};
  EXPECT_TRUE(Body::make(mesh, Formulation::kLinear, muscle));
  EXPECT_EQ(Body::make(mesh, Formulation::kStabilised, muscle).error().code, ErrorCode::kUsage);
  const Body body = body_of(mesh, Formulation::kLinear);
  EXPECT_FALSE(LoadSteps::start(body, {}, {true}, {}));
}

}  // namespace
}  // namespace voxtet::mechanics
