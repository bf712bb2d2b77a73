#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/digest.h"
#include "physics/beat/beat_record.h"
#include "physics/beat/energy_account.h"
#include "physics/beat/heart_fields.h"
#include "physics/beat/heart_steps.h"
#include "physics/beat/make_heart.h"
#include "physics/mechanics/elements/mass.h"
#include "physics/mechanics/solve/load_steps.h"
#include "support/beating_ventricle.h"
#include "support/bricks.h"

namespace voxtet::beat {
namespace {

using test::step;
using Ventricle = test::BeatingVentricle;

/// A short beat.
BeatParams quick() {
  BeatParams params;
  params.contraction = {ActiveStressPresetName::kFast, {}, {}, ActivationBy::kSynchronous, 60, 120};
  params.windkessel.systemic.atrium.duration_s = 0.05;
  params.windkessel.pulmonary.atrium.duration_s = 0.05;
  params.period_ms = 300;
  params.fill_ms = 50;
  params.beats = 1;
  return params;
}

MadeHeart made(const Ventricle& ventricle, const BeatParams& params) {
  auto heart = make_heart(ventricle.anatomy(), params);
  EXPECT_TRUE(heart.ok()) << (heart.ok() ? "" : heart.error().message);
  return std::move(heart).value();
}

HeartSteps steps_of(const MadeHeart& heart, const BeatParams& params) {
  HeartStepParams step;
  step.step_s = params.step_ms / 1000;
  return HeartSteps::start(heart.heart, heart.start, step).value();
}

TEST(Beat, MassIsThatOfTheVolume) {
  const TetMesh mesh = test::bricks({2, 1.5, 1}, {2, 2, 2});
  for (const auto formulation : {mechanics::Formulation::kLinear, mechanics::Formulation::kQuadratic}) {
    const auto body = mechanics::Body::make(mesh, formulation, {}).value();
    fem::SparseMatrix mass = body.empty_tangent();
    mechanics::add_mass(body.nodes(), 1e-6, mass);
    Eigen::VectorXd along(body.unknowns()), turning(body.unknowns()), product;
    for (std::size_t i = 0; i < body.nodes().places().size(); ++i) {
      const Eigen::Vector3d& x = body.nodes().places()[i];
      along.segment<3>(3 * static_cast<Eigen::Index>(i)) = Eigen::Vector3d::UnitX();
      turning.segment<3>(3 * static_cast<Eigen::Index>(i)) = Eigen::Vector3d::UnitZ().cross(x);
    }
    fem::multiply(mass, along, product);
    EXPECT_NEAR(along.dot(product), 3e-6, 1e-18);
    // The moment of inertia of a box about an edge: m (a^2 + b^2) / 3.
    fem::multiply(mass, turning, product);
    EXPECT_NEAR(turning.dot(product), 3e-6 * (4 + 2.25) / 3, 1e-17);
  }
}

TEST(Beat, ComesToRestWhereLoadsAreBalanced) {
  const Ventricle ventricle(1, 5);
  BeatParams params = quick();
  params.fill_ms = 100;
  MadeHeart heart = made(ventricle, params);
  auto held = std::make_shared<Heart>(Heart{heart.heart->body,
                                            heart.heart->mass,
                                            heart.heart->springs,
                                            heart.heart->dampers,
                                            heart.heart->cavities,
                                            {},
                                            {},
                                            nullptr});
  held->given_kpa = [](double time_s) {
    return Eigen::VectorXd::Constant(1, std::min(1.0, 1 + 10 * time_s));
  };
  HeartMotion start = heart.start;
  start.circulation = {};
  HeartStepParams step_params;
  step_params.tolerance = 1e-9;
  auto steps = HeartSteps::start(held, start, step_params).value();
  while (steps.now().time_s < 3) ASSERT_TRUE(step(steps));
  // The forces without any motion.
  Eigen::VectorXd force = Eigen::VectorXd::Zero(steps.now().u.size()), pull;
  ASSERT_TRUE(held->body.add_forces(steps.now().u, {}, force, nullptr));
  const double scale = force.norm();
  fem::multiply(held->springs, steps.now().u, pull);
  force += pull;
  held->cavities[0].add_gradient(held->body.nodes().places_after(steps.now().u), -1, force);
  EXPECT_LT(force.norm(), 1e-5 * scale);
  EXPECT_GT(steps.now().cavity_ml[0],
            1.1 * heart.heart->cavities[0].volume_mm3(held->body.nodes().places_after({})) / 1000);
}

TEST(Beat, EjectsWhatTheCirculationTakes) {
  const Ventricle ventricle(1, 5);
  const BeatParams params = quick();
  const MadeHeart heart = made(ventricle, params);
  HeartSteps steps = steps_of(heart, params);
  BeatRecord record(params, heart.heart->circulation->state_names(), steps.now());
  double out_ml = 0;
  while (!record.is_over()) {
    const HeartMotion before = steps.now();
    ASSERT_TRUE(step(steps));
    const HeartMotion& now = steps.now();
    record.add(before, now);
    if (before.time_s < 0) continue;
    const auto blood = step_circulation(*heart.heart->circulation, before.circulation, now.time_s,
                                        now.time_s - before.time_s, now.cavity_kpa);
    ASSERT_TRUE(blood.ok());
    const double dt = now.time_s - before.time_s;
    EXPECT_NEAR(now.cavity_ml[0] - before.cavity_ml[0], dt * blood->inflow_ml_per_s[0], 1e-3);
    out_ml += std::max(0.0, -dt * blood->inflow_ml_per_s[0]);
  }
  ASSERT_EQ(record.measures().beats.size(), 1U);
  const VentricleBeat& beat = record.measures().beats[0][0];
  EXPECT_NEAR(beat.stroke_ml(), out_ml, 0.02 * out_ml);
  EXPECT_GT(beat.ejection_fraction(), 0.3);
  EXPECT_GT(beat.most_kpa, 10);
  EXPECT_GT(beat.stroke_work_j, 0.8 * 10 * beat.stroke_ml() / 1000);
}

TEST(Beat, BalancesItsEnergy) {
  const Ventricle ventricle(1, 5);
  BeatParams params = quick();
  params.step_ms = 1;
  const MadeHeart heart = made(ventricle, params);
  HeartSteps steps = steps_of(heart, params);
  while (steps.now().time_s < 0) ASSERT_TRUE(step(steps));
  auto account = EnergyAccount::start(*heart.heart, steps.now()).value();
  while (steps.now().time_s < params.period_ms / 1000 - 1e-9) {
    ASSERT_TRUE(step(steps));
    ASSERT_TRUE(account.add(steps.now()));
  }
  const EnergyBalance& all = account.balance();
  EXPECT_GT(all.active, 300);
  EXPECT_LT(all.blood, -200);
  EXPECT_GT(all.viscous, 0);
  EXPECT_GT(all.dampers, 0);
  EXPECT_LT(std::abs(all.missing()), 0.01 * all.active);
}

TEST(Beat, GoesOnFromAStateWithTheSameBytes) {
  const Ventricle ventricle(1, 4);
  const BeatParams params = quick();
  const MadeHeart heart = made(ventricle, params);
  HeartSteps whole = steps_of(heart, params), later = steps_of(heart, params);
  while (whole.now().time_s < 0.08) ASSERT_TRUE(step(whole));
  ASSERT_TRUE(later.restore(whole.take_state()));
  while (whole.now().time_s < 0.15) {
    ASSERT_TRUE(step(whole));
    ASSERT_TRUE(step(later));
  }
  EXPECT_EQ((whole.now().u - later.now().u).cwiseAbs().maxCoeff(), 0);
  EXPECT_EQ(whole.now().cavity_kpa[0], later.now().cavity_kpa[0]);
  const MadeHeart other = made(Ventricle(1, 5), params);
  HeartSteps another = steps_of(other, params);
  EXPECT_FALSE(another.restore(whole.take_state()));
}

TEST(Beat, SaysWhenAndWhereItFails) {
  const Ventricle ventricle(1, 4);
  BeatParams params = quick();
  params.contraction.lv = ActiveStressLaw{1e6, 1e4, 20, 0};
  const MadeHeart heart = made(ventricle, params);
  HeartSteps steps = steps_of(heart, params);
  Status failed = std::monostate{};
  while (failed && steps.now().time_s < 0.3) failed = step(steps);
  ASSERT_FALSE(failed.ok());
  EXPECT_EQ(failed.error().code, ErrorCode::kMeshing);
  EXPECT_NE(failed.error().message.find(" ms to "), std::string::npos) << failed.error().message;
  EXPECT_TRUE(steps.now().u.allFinite());
}

TEST(Beat, RefusesWhatNoHeartHas) {
  const auto message = [](const BeatParams& params) {
    const Status checked = check_beat_params(params);
    return checked.ok() ? std::string() : checked.error().message;
  };
  EXPECT_EQ(message(BeatParams{}), "");
  BeatParams params;
  params.labels = {{{1}, 2, 1}, {{1}, 1, 0}};
  EXPECT_NE(message(params).find("labels[1].labels: label 1 has an entry before"), std::string::npos);
  params = {};
  params.material.guccione.emplace();
  params.material.mooney_rivlin.emplace();
  EXPECT_NE(message(params).find("material: found 2 materials"), std::string::npos);
  params = {};
  params.frame_ms = 7;
  EXPECT_NE(message(params).find("frame_ms: found 7"), std::string::npos);
  params = {};
  params.windkessel.systemic.arteries.compliance_ml_per_kpa = 0;
  EXPECT_NE(message(params).find("compliance_ml_per_kpa"), std::string::npos);
  params = {};
  params.closed_loop.emplace();
  const Ventricle ventricle(1, 3);
  const auto heart = make_heart(ventricle.anatomy(), params);
  ASSERT_FALSE(heart.ok());
  EXPECT_NE(heart.error().message.find("closed_loop"), std::string::npos);
}

TEST(Beat, FieldsAreThoseOfTheMotion) {
  const Ventricle ventricle(1, 3);
  const MadeHeart heart = made(ventricle, quick());
  // Twice as long along x.
  HeartMotion motion = heart.start;
  motion.u = Eigen::VectorXd::Zero(heart.heart->body.unknowns());
  for (std::size_t i = 0; i < ventricle.body.mesh.points.size(); ++i)
    motion.u[3 * static_cast<Eigen::Index>(i)] = ventricle.body.mesh.points[i].x();
  const std::vector<Field> fields = heart_fields(ventricle.anatomy(), heart, motion);
  EXPECT_FLOAT_EQ(find_field(fields, "displacement_mm")->values[3],
                  static_cast<float>(ventricle.body.mesh.points[1].x()));
  for (std::size_t t = 0; t < ventricle.body.mesh.tets.size(); ++t) {
    for (const auto& [name, along] : {std::pair{"fibre_strain_percent", ventricle.fibres.fibre[t]},
                                      std::pair{"thickening_percent", ventricle.across[t]}})
      EXPECT_NEAR(find_field(fields, name)->values[t],
                  100 * (Eigen::Vector3d(2 * along.x(), along.y(), along.z()).norm() - 1), 1e-4);
  }
}

}  // namespace
}  // namespace voxtet::beat
