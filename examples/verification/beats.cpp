// Hearts that beat: what number of layers and which element an ejection fraction needs, the benchmark of
// elastodynamics, and where the work of a beat goes.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "geometry/elements/tet_measures.h"
#include "physics/active/pressure_curve.h"
#include "physics/beat/beat_record.h"
#include "physics/beat/energy_account.h"
#include "support/beating_ventricle.h"
#include "verify.h"

namespace voxtet::verify {
namespace {

using mechanics::Formulation;

constexpr Formulation kElements[] = {Formulation::kLinear, Formulation::kAverageNodalPressure,
                                     Formulation::kStabilised, Formulation::kQuadratic};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void exit_unless(const Status& done) {
  if (done) return;
  std::fprintf(stderr, "verify_physics: %s\n", done.error().message.c_str());
  std::exit(1);
}

beat::HeartSteps steps_of(const beat::MadeHeart& heart, double step_ms) {
  beat::HeartStepParams params;
  params.step_s = step_ms / 1000;
  return value_or_exit(beat::HeartSteps::start(heart.heart, heart.start, params));
}

BeatParams one_beat(Formulation element) {
  BeatParams params;
  params.element = element;
  params.contraction.by = ActivationBy::kSynchronous;
  params.beats = 1;
  return params;
}

struct Beaten {
  VentricleBeat beat;
  double seconds;
};

Beaten first_beat(const test::BeatingVentricle& ventricle, const BeatParams& params) {
  const auto start = std::chrono::steady_clock::now();
  const beat::MadeHeart heart = value_or_exit(beat::make_heart(ventricle.anatomy(), params));
  beat::HeartSteps steps = steps_of(heart, params.step_ms);
  beat::BeatRecord record(params, heart.heart->circulation->state_names(), steps.now());
  while (!record.is_over()) {
    const beat::HeartMotion before = steps.now();
    exit_unless(test::step(steps));
    record.add(before, steps.now());
  }
  return {record.measures().beats[0][0], seconds_since(start)};
}

// The benchmark of Arostica et al. (2025), problem 1 with one ventricle. Here z is its x.

constexpr double kInnerBase = 90.0 * 5 / 17, kOuterBase = 97.0 * 5 / 20;
constexpr test::Ellipsoid kBenchmark{25, 35, 90, 97, kInnerBase, kOuterBase - kInnerBase};

/// Where a probe is: a tetrahedron, and the shares of its nodes.
struct Probe {
  const char* name;
  Eigen::Vector3d place;
};
constexpr int kProbes = 2;
const std::array<Probe, kProbes> kBenchmarkProbes{
    {{"p0", Eigen::Vector3d(30, 0, 25)}, {"p1", Eigen::Vector3d(30, 0, 0)}}};

/// Displacement of an undeformed place, mm, from the tetrahedron that it lies deepest in.
Eigen::Vector3d displacement_at(const TetMesh& mesh, const mechanics::Nodes& nodes, const Eigen::VectorXd& u,
                                const Eigen::Vector3d& place) {
  std::size_t best = 0;
  double deepest = -1e9;
  std::array<double, 4> share{};
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const fem::Element element = fem::element_of(mesh, t);
    std::array<double, 4> here{};
    double least = 1;
    for (std::size_t a = 0; a < 4; ++a) {
      // Linear, 1 at the corner and 0 at the others, of which the next one is.
      const Eigen::Vector3d& zero = mesh.points[mesh.tets[t][(a + 1) % 4]];
      here[a] = element.gradient[a].dot(place - zero);
      least = std::min(least, here[a]);
    }
    if (least > deepest) deepest = least, best = t, share = here;
  }
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const auto node = [&](std::size_t a) -> Eigen::Vector3d {
    return u.segment<3>(3 * static_cast<Eigen::Index>(nodes.of_tet(best)[a]));
  };
  for (std::size_t a = 0; a < 4; ++a)
    sum += (nodes.quadratic() ? share[a] * (2 * share[a] - 1) : share[a]) * node(a);
  for (std::size_t e = 0; nodes.quadratic() && e < 6; ++e) {
    const auto [a, b] = kEdgesOfTet[e];
    sum += 4 * share[static_cast<std::size_t>(a)] * share[static_cast<std::size_t>(b)] * node(4 + e);
  }
  return sum;
}

void print_benchmark(Formulation element, std::uint32_t layers, std::uint32_t rings, double step_ms,
                     double end_ms) {
  const test::BeatingVentricle ventricle(layers, rings, true, kBenchmark, -60, 60);
  BeatParams params = one_beat(element);
  params.material.holzapfel_ogden.emplace();
  params.bulk_kpa = 1000;
  params.viscosity_kpa_s = 0.1;
  params.support = {100, 0.1, 5e-3};
  params.period_ms = 1000;
  params.step_ms = step_ms;
  params.fill_ms = 10 * step_ms;
  params.contraction.preset = ActiveStressPresetName::kElastodynamics;
  params.contraction.start_ms = 160;
  params.contraction.duration_ms = 484 - 160;
  beat::MadeHeart heart = value_or_exit(beat::make_heart(ventricle.anatomy(), params));
  // Pressures as given, from 0 at time 0.
  const PressureCurve curve = value_or_exit(pressure_curve("monoventricle"));
  const std::vector<double> kpa = pressures_kpa(curve, end_ms, 0.05);
  const auto given = [kpa](double time_s) {
    const auto i = static_cast<std::size_t>(std::max(0.0, std::round(1000 * time_s / 0.05)));
    return Eigen::VectorXd(Eigen::VectorXd::Constant(1, kpa[std::min(i, kpa.size() - 1)]));
  };
  heart.heart = std::make_shared<beat::Heart>(
      beat::Heart{heart.heart->body, heart.heart->mass, heart.heart->springs, heart.heart->dampers,
                  heart.heart->cavities, heart.heart->tension_kpa, given, nullptr});
  heart.start.circulation = {};
  heart.start.time_s = 0;
  const auto start = std::chrono::steady_clock::now();
  beat::HeartSteps steps = steps_of(heart, step_ms);
  double next_ms = 50;
  std::printf("  %s, %u layers, %u rings, %zu tetrahedra, %td unknowns, steps of %g ms\n    ms",
              name_of(element), layers, rings, ventricle.body.mesh.tets.size(), heart.heart->body.unknowns(),
              step_ms);
  for (const Probe& probe : kBenchmarkProbes) std::printf("   %s: along  radial  around", probe.name);
  std::printf("     ml\n");
  while (steps.now().time_s < end_ms / 1000 - 1e-9) {
    exit_unless(test::step(steps));
    if (1000 * steps.now().time_s < next_ms - 1e-6) continue;
    next_ms += 50;
    std::printf("  %5.0f", 1000 * steps.now().time_s);
    for (const Probe& probe : kBenchmarkProbes) {
      const Eigen::Vector3d u =
          displacement_at(ventricle.body.mesh, heart.heart->body.nodes(), steps.now().u, probe.place);
      std::printf("  %9.3f %7.3f %7.3f", u.z(), u.x(), u.y());
    }
    std::printf("  %6.2f\n", steps.now().cavity_ml[0]);
    std::fflush(stdout);
  }
  std::printf("    %.0f s, %d steps, %d iterations of Newton's method\n", seconds_since(start), steps.steps(),
              steps.newton_iterations());
}

}  // namespace

void print_layers(bool all) {
  constexpr std::uint32_t kRings = 6;
  std::printf(
      "An ellipsoid of 9 mm of wall with layers of the same size along it, one beat: ejection fraction, %%, "
      "with a "
      "fibre for each tetrahedron and with four\n  element  layers  tetrahedra  one fibre  four fibres  "
      "seconds\n");
  for (const Formulation element : kElements)
    for (std::uint32_t layers = 1; layers <= (all || element != Formulation::kQuadratic ? 4U : 2U);
         ++layers) {
      std::array<double, 2> ef{};
      double seconds = 0;
      std::size_t tets = 0;
      for (const bool fine : {false, true}) {
        const test::BeatingVentricle ventricle(layers, kRings, fine);
        BeatParams params = one_beat(element);
        params.fine_fibres = fine;
        const Beaten done = first_beat(ventricle, params);
        ef[fine ? 1 : 0] = 100 * done.beat.ejection_fraction();
        seconds = done.seconds;
        tets = ventricle.body.mesh.tets.size();
      }
      std::printf("  %-7s  %6u  %10zu  %9.2f  %11.2f  %7.1f\n", name_of(element), layers, tets, ef[0], ef[1],
                  seconds);
      std::fflush(stdout);
    }
}

void print_elastodynamics(bool all) {
  std::printf(
      "Arostica et al. (2025), problem 1, one ventricle, active stress and pressure: displacement of the "
      "probes, mm, "
      "along the ventricle's axis (to the base), radial and around it\n");
  for (const Formulation element : kElements) {
    if (element == Formulation::kLinear && !all) continue;
    print_benchmark(element, 1, 8, all ? 1 : 2, 1000);
    if (!all) continue;
    print_benchmark(element, 2, 12, 1, 1000);
  }
}

void print_beat(bool) {
  const char* const check = "A beat of an ellipsoid";
  const char* const source = "conservation";
  const test::BeatingVentricle ventricle(1, 6);
  BeatParams params = one_beat(Formulation::kAverageNodalPressure);
  params.step_ms = 1;
  const beat::MadeHeart heart = value_or_exit(beat::make_heart(ventricle.anatomy(), params));
  beat::HeartSteps steps = steps_of(heart, params.step_ms);
  while (steps.now().time_s < 0) exit_unless(test::step(steps));
  auto account = value_or_exit(beat::EnergyAccount::start(*heart.heart, steps.now()));
  double most_change = 0;
  const auto& nodes = heart.heart->body.nodes();
  const auto wall_mm3 = [&](const Eigen::VectorXd& u) {
    return mechanics::Surface(nodes, ventricle.body.mesh.faces).volume_mm3(nodes.places_after(u));
  };
  const double wall = wall_mm3({});
  while (steps.now().time_s < params.period_ms / 1000 - 1e-9) {
    exit_unless(test::step(steps));
    exit_unless(account.add(steps.now()));
    most_change = std::max(most_change, std::abs(wall_mm3(steps.now().u) / wall - 1));
  }
  const beat::EnergyBalance& all = account.balance();
  print_check(check, "energy not accounted for, of the work of contraction", 100 * all.missing() / all.active,
              "%", -1, 1, "0 %, within 1 %", source);
  print_check(check, "greatest change of the wall's volume", 100 * most_change, "%", 0, 2, "less than 2 %",
              source);
}

}  // namespace voxtet::verify
