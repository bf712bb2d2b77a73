#include "physics/monodomain/monodomain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/digest.h"
#include "support/bricks.h"

namespace voxtet {
namespace {

Tissue all_of(const TetMesh& mesh, const TissueKind& kind = {}) {
  return {{kind}, std::vector<std::uint16_t>(mesh.tets.size(), 0), {}, {}};
}

/// Of the box around the origin's corner.
Stimulus at_corner(const Eigen::Vector3d& half_size_mm) {
  Stimulus stimulus;
  stimulus.shape = RegionShape::kBox;
  stimulus.half_size_mm = half_size_mm;
  return stimulus;
}

Monodomain started(const TetMesh& mesh, const Tissue& tissue, const std::vector<Stimulus>& stimuli,
                   const MonodomainParams& params, int threads = 1) {
  auto started = Monodomain::start(mesh, tissue, stimuli, params, threads);
  EXPECT_TRUE(started.ok()) << (started.ok() ? "" : started.error().message);
  return *std::move(started);
}

/// To the end, or the first error.
Status run(Monodomain& heart) {
  while (!heart.done())
    if (const Result<bool> advanced = heart.advance(); !advanced) return advanced.error();
  return std::monostate{};
}

std::vector<float> activations(const TetMesh& mesh, const Tissue& tissue,
                               const std::vector<Stimulus>& stimuli, const MonodomainParams& params) {
  Monodomain heart = started(mesh, tissue, stimuli, params);
  const Status ran = run(heart);
  EXPECT_TRUE(ran.ok()) << (ran.ok() ? "" : ran.error().message);
  return heart.activation_fields()[0].values;
}

/// Of a plane wave along a bar of bricks of this length, in its middle.
double bar_speed(double edge_mm, const MonodomainParams& params, const TissueKind& kind = {}) {
  const int length = static_cast<int>(std::lround(18 / edge_mm));
  const TetMesh bar = test::bricks_cut_all_ways({length * edge_mm, 0.5, 0.5}, {length, 1, 1});
  const auto times = activations(bar, all_of(bar, kind), {at_corner({1.5, 9, 9})}, params);
  const auto from = static_cast<std::size_t>(length / 2), to = static_cast<std::size_t>(3 * length / 4);
  return (bar.points[to][0] - bar.points[from][0]) / (times[to] - times[from]);
}

TEST(Monodomain, PlaneWaveHasTheSpeedOfTheTissue) {
  for (const Integration integration : {Integration::kExplicit, Integration::kSemiImplicit})
    EXPECT_NEAR(bar_speed(0.1, {.integration = integration, .end_ms = 40, .step_ms = 0.01, .frame_ms = 50}),
                0.5, 0.005);
}

TEST(Monodomain, SpeedIsCalibratedForEveryCell) {
  const MonodomainParams params{.end_ms = 50, .step_ms = 0.01, .frame_ms = 60};
  // Of a gate that hardly closes within the front; one that does costs about 1 %.
  TissueKind slow{
      .along_mm_per_ms = 0.4, .across_mm_per_ms = 0.4, .cell = {.tau_in_ms = 0.4, .tau_close_ms = 1500}};
  EXPECT_NEAR(bar_speed(0.1, params, slow), 0.4, 0.002);
  slow.cell.modified = true;
  EXPECT_NEAR(bar_speed(0.1, params, slow), 0.4, 0.002);
}

/// The set-up of Niederer et al., Phil. Trans. R. Soc. A 369 (2011), with the cell of Mitchell and Schaeffer:
/// 20 x 7 x 3 mm, fibres along x.
struct Slab {
  TetMesh mesh;
  Tissue tissue;
  Stimulus stimulus = at_corner({1.5, 1.5, 1.5});
};

Slab niederer_slab(double edge_mm, bool all_ways = false) {
  const auto bricks = [&](double length) { return static_cast<int>(std::lround(length / edge_mm)); };
  const std::array<int, 3> count{bricks(20), bricks(7), bricks(3)};
  Slab slab;
  slab.mesh = all_ways ? test::bricks_cut_all_ways({20, 7, 3}, count) : test::bricks({20, 7, 3}, count);
  const double unit = plane_wave_speed({});
  slab.tissue = all_of(slab.mesh, {unit * std::sqrt(0.0953), unit * std::sqrt(0.012576), {}});
  slab.tissue.fibre.assign(slab.mesh.tets.size(), Eigen::Vector3d::UnitX());
  return slab;
}

TEST(Monodomain, SlabIsActivatedAsByTheSevenPointStencil) {
  // Times of a finite-difference code: seven points, mirrored at the boundary, the same splitting.
  const Slab slab = niederer_slab(0.5, true);
  const auto times =
      activations(slab.mesh, slab.tissue, {slab.stimulus},
                  {.integration = Integration::kExplicit, .end_ms = 90, .step_ms = 0.01, .frame_ms = 90});
  const auto at = [&](int i, int j, int k) { return times[static_cast<std::size_t>(i + 41 * (j + 15 * k))]; };
  EXPECT_NEAR(at(40, 0, 0), 58.32, 0.01);
  EXPECT_NEAR(at(0, 14, 0), 54.91, 0.01);
  EXPECT_NEAR(at(20, 7, 3), 37.67, 0.01);
  EXPECT_NEAR(at(40, 14, 6), 82.47, 0.01);
}

TEST(Monodomain, IntegrationsAgreeInTheLimitOfShortSteps) {
  // With the same mass they differ by the error of the step alone.
  const Slab slab = niederer_slab(1);
  std::vector<float> end[2];
  for (const double step : {0.04, 0.02}) {
    const auto ends = [&](Integration integration) {
      return activations(slab.mesh, slab.tissue, {slab.stimulus},
                         {.integration = integration, .end_ms = 90, .step_ms = step, .consistent_mass = 0});
    };
    const auto first = ends(Integration::kExplicit), second = ends(Integration::kSemiImplicit);
    auto& gap = end[step == 0.04 ? 0 : 1];
    for (std::size_t i = 0; i < first.size(); ++i) gap.push_back(std::abs(first[i] - second[i]));
  }
  const auto largest = [](const std::vector<float>& gap) {
    return *std::max_element(gap.begin(), gap.end());
  };
  EXPECT_LT(largest(end[0]), 0.5);
  EXPECT_NEAR(largest(end[0]) / largest(end[1]), 2, 0.4);
}

TEST(Monodomain, ScarConductsNothingAndTheWaveGoesAround) {
  // A plate of scar across the slab, open at one end.
  const TetMesh mesh = test::bricks({20, 10, 1}, {40, 20, 2});
  Tissue tissue = all_of(mesh);
  std::vector<bool> in_scar(mesh.points.size(), true);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const auto p : mesh.tets[t]) centre += mesh.points[p] / 4;
    if (centre[0] > 9 && centre[0] < 11 && centre[1] < 8) tissue.kind[t] = Tissue::kNone;
    for (const auto p : mesh.tets[t])
      if (tissue.kind[t] != Tissue::kNone) in_scar[p] = false;
  }
  const auto times = activations(mesh, tissue, {at_corner({1, 20, 20})}, {.end_ms = 80});
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_EQ(std::isnan(times[i]), in_scar[i]) << i;
  // Behind the plate, at the end that is closed, the wave comes over the corner at (11, 8).
  const double straight = times[20 * 41 + 30], behind = times[24];
  EXPECT_GT(behind, straight);
  EXPECT_NEAR(behind - times[8 * 2 * 41 + 22], 8 / 0.5, 2.5);
}

TEST(Monodomain, BytesDependNeitherOnCutsNorOnThreads) {
  const Slab slab = niederer_slab(1);
  for (const Integration integration : {Integration::kExplicit, Integration::kSemiImplicit}) {
    const MonodomainParams params{.integration = integration, .end_ms = 20};
    Monodomain one = started(slab.mesh, slab.tissue, {slab.stimulus}, params, 1);
    Monodomain three = started(slab.mesh, slab.tissue, {slab.stimulus}, params, 3);
    ASSERT_TRUE(run(one).ok());
    ASSERT_TRUE(run(three).ok());
    EXPECT_EQ(one.voltage().values.size(), three.voltage().values.size());
    EXPECT_TRUE((one.v().array() == three.v().array()).all());
  }
}

TEST(Monodomain, PacesAsOftenAsItIsTold) {
  const TetMesh mesh = test::bricks({6, 1, 1}, {12, 2, 2});
  Stimulus stimulus = at_corner({1, 9, 9});
  stimulus.start_ms = 10;
  stimulus.count = 2;
  stimulus.interval_ms = 500;
  stimulus.s2_ms = 400;
  EXPECT_EQ(start_times_ms(stimulus), (std::vector<double>{10, 510, 910}));
  Monodomain heart = started(mesh, all_of(mesh), {stimulus}, {.end_ms = 1000, .step_ms = 0.1});
  ASSERT_TRUE(run(heart).ok());
  const auto fields = heart.activation_fields();
  for (const float count : find_field(fields, "activations")->values) EXPECT_EQ(count, 3);
  const auto last = heart.log().last_activation(mesh.points.size());
  EXPECT_NEAR(last[0], 912, 3);
  // As long as that of a cell alone, but for 1 % of the gate, which closes while the wave comes.
  const CellStep cell({}, 0.1);
  double v = 0.5, w = 1, lasted = 0;
  for (; v > ActivationLog::kRepolarised; lasted += 0.1) cell.react(v, w, 0);
  EXPECT_NEAR(find_field(fields, "apd_ms")->values[6], lasted, 0.01 * 150);
}

TEST(Monodomain, AnotherStimulusMayComeWhileItRuns) {
  const TetMesh mesh = test::bricks({6, 1, 1}, {12, 2, 2});
  Monodomain heart = started(mesh, all_of(mesh), {}, {.end_ms = 60});
  while (heart.time_ms() < 20) ASSERT_TRUE(heart.advance().ok());
  Stimulus later = at_corner({1, 9, 9});
  later.start_ms = 20;
  ASSERT_TRUE(heart.stimulate(later).ok());
  ASSERT_TRUE(run(heart).ok());
  const std::vector<Field> fields = heart.activation_fields();
  for (const float time : fields[0].values) EXPECT_TRUE(time > 20 && time < 40) << time;
}

TEST(Monodomain, GoesOnFromAStateAsIfItHadNeverStopped) {
  const TetMesh mesh = test::bricks({6, 2, 2}, {12, 4, 4});
  Stimulus paced = at_corner({1, 9, 9});
  paced.count = 2, paced.interval_ms = 15;
  for (const Integration integration : {Integration::kExplicit, Integration::kSemiImplicit}) {
    const MonodomainParams params{.integration = integration, .end_ms = 40};
    Monodomain whole = started(mesh, all_of(mesh), {paced}, params);
    ASSERT_TRUE(run(whole).ok());
    Monodomain first = started(mesh, all_of(mesh), {paced}, {.integration = integration, .end_ms = 16});
    ASSERT_TRUE(run(first).ok());
    Monodomain second = started(mesh, all_of(mesh), {paced}, params);
    ASSERT_TRUE(second.restore(first.state()).ok());
    EXPECT_DOUBLE_EQ(second.time_ms(), 16);
    ASSERT_TRUE(run(second).ok());
    EXPECT_TRUE(second.v() == whole.v());
    EXPECT_EQ(second.activation_fields()[0].values, whole.activation_fields()[0].values);
    EXPECT_EQ(second.activation_fields()[4].values, whole.activation_fields()[4].values);

    EXPECT_EQ(
        started(test::bricks({6, 2, 2}, {6, 2, 2}), all_of(test::bricks({6, 2, 2}, {6, 2, 2})), {}, params)
            .restore(first.state())
            .error()
            .message,
        "state: found 325 points, expected the 63 that conduct");
    EXPECT_EQ(started(mesh, all_of(mesh), {}, {.end_ms = 40, .step_ms = 0.1})
                  .restore(first.state())
                  .error()
                  .message,
              "state: found a step of 0.050000 ms, expected 0.100000 ms");
    EXPECT_EQ(
        started(mesh, all_of(mesh), {}, {.end_ms = 10}).restore(first.state()).error().message,
        "physics.monodomain.end_ms: found 10, expected at least the 16.000000 ms that the state has reached");
  }
}

TEST(Monodomain, ElectrodesSeeAWaveComeAndGo) {
  const TetMesh mesh = test::bricks({20, 2, 2}, {40, 4, 4});
  Monodomain heart = started(mesh, all_of(mesh), {at_corner({1, 9, 9})},
                             {.end_ms = 60, .electrodes = {{"middle", {10, 4, 1}}, {"end", {40, 1, 1}}}});
  std::vector<double> middle, end;
  while (!heart.done()) {
    ASSERT_TRUE(heart.advance().ok());
    middle.push_back(heart.potentials_mv()[0]);
    end.push_back(heart.potentials_mv()[1]);
  }
  // Positive while it comes, negative once it is past; what only comes stays positive.
  EXPECT_LT(std::max_element(middle.begin(), middle.end()), std::min_element(middle.begin(), middle.end()));
  EXPECT_GT(*std::max_element(middle.begin(), middle.end()), 0.1);
  EXPECT_GT(*std::max_element(end.begin(), end.end()), -20 * *std::min_element(end.begin(), end.end()));
}

TEST(Electrogram, OfAUniformGradientIsThatOfADipole) {
  const TetMesh mesh = test::bricks({1, 1, 1}, {4, 4, 4});
  Tissue tissue = all_of(mesh);
  const auto part = conducting_mesh(mesh, tissue);
  ASSERT_TRUE(part.ok());
  const Eigen::Vector3d away(12, 9, 0), centre(0.5, 0.5, 0.5);
  const Eigen::VectorXd weights = electrogram_weights(*part, centre + away);
  Eigen::VectorXd v(weights.size());
  for (Eigen::Index i = 0; i < v.size(); ++i) v[i] = part->mesh.points[static_cast<std::size_t>(i)][0];
  // The dipole - sigma grad V over 1 mm^3; a cube's first correction is of the fourth order of its size.
  const double sigma = 1.4 * diffusivity_of(0.5, {}), moment = -sigma * 100;
  EXPECT_NEAR(weights.dot(v) / (moment * away[0] / (4 * EIGEN_PI * std::pow(away.norm(), 3))), 1, 1e-4);
  EXPECT_NEAR(weights.sum(), 0, 1e-14);
}

TEST(Monodomain, SaysWhatIsWrong) {
  const Slab slab = niederer_slab(1);
  const auto fault = [&](const Tissue& tissue, const std::vector<Stimulus>& stimuli,
                         const MonodomainParams& params) {
    auto started = Monodomain::start(slab.mesh, tissue, stimuli, params);
    if (!started) return started.error().message;
    const Status ran = run(*started);
    return ran ? std::string() : ran.error().message;
  };
  Stimulus away = slab.stimulus;
  away.centre_mm = {0, 0, 8};
  away.name = "apex";
  EXPECT_EQ(fault(slab.tissue, {slab.stimulus, away}, {}),
            "physics.stimuli[1] (apex): found no point of conducting tissue in its region, expected at least "
            "one; the "
            "nearest is 3.5 mm away");
  Tissue dead = slab.tissue;
  dead.kind.assign(dead.kind.size(), Tissue::kNone);
  EXPECT_NE(fault(dead, {}, {}).find("found no tetrahedron that conducts"), std::string::npos);
  Tissue still = slab.tissue;
  still.kinds[0].across_mm_per_ms = 0;
  EXPECT_NE(fault(still, {}, {}).find("physics.tissue.kinds[0].across_mm_per_ms: found 0"),
            std::string::npos);
  EXPECT_NE(fault(slab.tissue, {}, {.step_ms = 0}).find("monodomain.step_ms: found 0"), std::string::npos);
  EXPECT_NE(fault(slab.tissue, {}, {.consistent_mass = 2}).find("consistent_mass: found 2"),
            std::string::npos);
}

TEST(Monodomain, AnExplicitStepBeyondStabilityIsRefusedWithTheLimit) {
  // The seven-point stencil's largest eigenvalue is 4 D (1 / hx^2 + 1 / hy^2 + 1 / hz^2), as good as reached
  // here.
  const TetMesh mesh = test::bricks_cut_all_ways({5, 5, 5}, {10, 10, 10});
  const double limit = 2 / (12 * diffusivity_of(1, {}) / 0.25);
  const TissueKind fast{.along_mm_per_ms = 1, .across_mm_per_ms = 1, .cell = {}};
  Monodomain heart = started(mesh, all_of(mesh, fast), {},
                             {.integration = Integration::kExplicit, .end_ms = 10, .step_ms = 0.2});
  const Status ran = run(heart);
  ASSERT_FALSE(ran.ok());
  EXPECT_EQ(ran.error().code, ErrorCode::kUsage);
  EXPECT_NE(ran.error().message.find("monodomain.step_ms: found 0.2"), std::string::npos)
      << ran.error().message;
  EXPECT_LT(heart.most_explicit_step_ms(), limit);
  EXPECT_GT(heart.most_explicit_step_ms(), 0.94 * limit);
}

TEST(Monodomain, HasTheSameBytesOnEveryPlatform) {
  const Slab slab = niederer_slab(1);
  Monodomain heart = started(slab.mesh, slab.tissue, {slab.stimulus}, {.end_ms = 60, .step_ms = 0.1});
  ASSERT_TRUE(run(heart).ok());
  Sha256 digest;
  for (const Field& field : heart.activation_fields())
    digest.update_values(field.values.data(), field.values.size());
  EXPECT_EQ(digest.hex().substr(0, 16), "202b5649a681aabc");
}

}  // namespace
}  // namespace voxtet
