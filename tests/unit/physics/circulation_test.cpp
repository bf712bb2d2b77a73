#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/digest.h"
#include "physics/circulation/check_circulation.h"
#include "physics/circulation/closed_loop.h"
#include "physics/circulation/elastance_heart.h"
#include "physics/circulation/windkessel.h"

namespace voxtet {
namespace {

constexpr double kMillimetreOfMercury = 0.133322387415;  // kPa

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// Derivatives by central differences, a column for each of the arguments.
Matrix differences(const std::function<Vector(const Vector&)>& function, const Vector& at, double h) {
  Matrix out(function(at).size(), at.size());
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    Vector more = at, less = at;
    more[i] += h;
    less[i] -= h;
    out.col(i) = (function(more) - function(less)) / (2 * h);
  }
  return out;
}

void expect_near(const Matrix& found, const Matrix& expected, double tolerance, const std::string& what) {
  ASSERT_EQ(found.rows(), expected.rows()) << what;
  ASSERT_EQ(found.cols(), expected.cols()) << what;
  const double scale = std::max(1.0, expected.cwiseAbs().maxCoeff());
  EXPECT_LE((found - expected).cwiseAbs().maxCoeff(), tolerance * scale) << what << "\n"
                                                                         << found << "\n\n"
                                                                         << expected;
}

void expect_exact_derivatives(const LumpedCirculation& circulation, double time_s, const Vector& states,
                              const Vector& kpa) {
  constexpr double kStep = 1e-3;
  const CirculationRates rates = circulation.rates(time_s, states, kpa);
  const auto of_states = [&](const Vector& y) { return circulation.rates(time_s, y, kpa); };
  const auto of_pressures = [&](const Vector& p) { return circulation.rates(time_s, states, p); };
  expect_near(rates.by_state, differences([&](const Vector& y) { return of_states(y).states; }, states, 1e-6),
              1e-6, "states by state");
  expect_near(rates.inflow_by_state,
              differences([&](const Vector& y) { return of_states(y).inflow_ml_per_s; }, states, 1e-6), 1e-6,
              "inflow by state");
  expect_near(rates.by_pressure,
              differences([&](const Vector& p) { return of_pressures(p).states; }, kpa, 1e-6), 1e-6,
              "states by pressure");
  expect_near(rates.inflow_by_pressure,
              differences([&](const Vector& p) { return of_pressures(p).inflow_ml_per_s; }, kpa, 1e-6), 1e-6,
              "inflow by pressure");
  const auto stepped = [&](const Vector& p) {
    return step_circulation(circulation, states, time_s, kStep, p);
  };
  const auto step = stepped(kpa);
  ASSERT_TRUE(step.ok()) << step.error().message;
  expect_near(step->inflow_by_pressure,
              differences([&](const Vector& p) { return stepped(p)->inflow_ml_per_s; }, kpa, 1e-6), 1e-6,
              "inflow of a step by pressure");
  // And it is a step of backward Euler.
  const CirculationRates at_end = circulation.rates(time_s, step->states, kpa);
  expect_near(step->states, states + kStep * at_end.states, 1e-12, "step");
  expect_near(step->inflow_ml_per_s, at_end.inflow_ml_per_s, 1e-12, "inflow of a step");
}

/// Filling, isovolumic, ejecting.
const std::vector<Eigen::Vector2d> kPressures{{0.8, 0.3}, {6, 1.9}, {14, 3.1}, {11.6893, 2.6058}};

struct Regazzoni {
  ClosedLoopHeart heart = regazzoni_heart();
  ClosedLoop loop{heart.loop};
  std::vector<Elastance> chambers{heart.left_ventricle, heart.right_ventricle};

  HeartBeat beat(const HeartState& state, int steps) const {
    auto beat = beat_heart(loop, chambers, heart.loop.period_s, state, steps);
    EXPECT_TRUE(beat.ok()) << (beat.ok() ? "" : beat.error().message);
    return *std::move(beat);
  }
  HeartBeat beats(int count, int steps) const {
    HeartBeat last = beat(start_of(heart), steps);
    for (int i = 1; i < count; ++i) last = beat(last.end, steps);
    return last;
  }
};

TEST(Valve, OpensOneWay) {
  const Valve valve;
  EXPECT_NEAR(flow_through(valve, 1).ml_per_s, 1000, 1e-2);
  EXPECT_NEAR(flow_through(valve, -10).ml_per_s, -1e-3, 1e-4);
  EXPECT_NEAR(flow_through(valve, 0).ml_per_s, valve.width_kpa / 2 / valve.open_kpa_s_per_ml, 1e-6);
  double before = -1;
  for (double x = -1; x < 1; x += 1e-3) {
    const ValveFlow flow = flow_through(valve, x);
    EXPECT_GT(flow.ml_per_s, before);
    EXPECT_GT(flow.slope, 0);
    const double h = 1e-7;
    const double slope =
        (flow_through(valve, x + h).ml_per_s - flow_through(valve, x - h).ml_per_s) / (2 * h);
    EXPECT_NEAR(flow.slope, slope, 1e-3);
    before = flow.ml_per_s;
  }
}

TEST(Valve, ThatIsRegurgitantLetsItsShareBack) {
  const Valve valve = regurgitant({}, 0.05);
  EXPECT_NEAR(flow_through(valve, -2).ml_per_s / flow_through(valve, 2).ml_per_s, -0.05, 1e-6);
}

TEST(Elastance, RisesAndFallsByHalfCosines) {
  const Elastance chamber{2, 0.1, 5, 0.6, 0.3, 0.2};
  const double period = 0.8;
  EXPECT_NEAR(elastance_at(chamber, 0.6, period), 0.1, 1e-14);
  EXPECT_NEAR(elastance_at(chamber, 0.7, period), 0.1 + 1 - std::cos(std::acos(-1) / 3), 1e-14);
  EXPECT_NEAR(elastance_at(chamber, 0.9, period), 2.1, 1e-14);
  EXPECT_NEAR(elastance_at(chamber, 0.1, period), 2.1, 1e-14);
  EXPECT_NEAR(elastance_at(chamber, 1.0, period), 1.1, 1e-14);
  EXPECT_NEAR(elastance_at(chamber, 1.3, period), 0.1, 1e-14);
}

TEST(ClosedLoop, HasExactDerivatives) {
  const Regazzoni model;
  for (const Eigen::Vector2d& kpa : kPressures)
    for (const double time_s : {0.05, 0.2, 0.7})
      expect_exact_derivatives(model.loop, time_s, model.heart.states, kpa);
}

TEST(ClosedLoop, NamesItsStates) {
  EXPECT_EQ(Regazzoni().loop.state_names().size(), std::size_t{loop::kStates});
  EXPECT_EQ(Regazzoni().loop.state_names()[loop::kPulmonaryVenousFlow], "pulmonary_venous_flow_ml_per_s");
}

TEST(ClosedLoop, KeepsItsBlood) {
  const Regazzoni model;
  HeartState state = start_of(model.heart);
  const double before = model.loop.blood_ml(state.circulation) + state.cavity_ml.sum();
  for (int i = 0; i < 2; ++i) state = model.beat(state, 800).end;
  EXPECT_NEAR(model.loop.blood_ml(state.circulation) + state.cavity_ml.sum(), before, 1e-11 * before);
}

TEST(ClosedLoop, OfRegazzoniReturnsToItsStateAfterTenBeats) {
  const Regazzoni model;
  const HeartState start = start_of(model.heart), end = model.beats(10, 800).end;
  EXPECT_NEAR(end.time_s, 8, 1e-9);
  for (Eigen::Index i = 0; i < start.circulation.size(); ++i)
    EXPECT_NEAR(end.circulation[i] / start.circulation[i], 1, 0.01)
        << model.loop.state_names()[static_cast<std::size_t>(i)];
  for (Eigen::Index c = 0; c < 2; ++c) EXPECT_NEAR(end.cavity_ml[c] / start.cavity_ml[c], 1, 0.01) << c;
}

TEST(ClosedLoop, OfRegazzoniHasTheBeatOfAnotherProgram) {
  // Forward Euler in steps of 0.1 ms with the published switch of the valves, the arc tangent of the
  // pressure.
  const auto expect = [](const VentricleBeat& found, double most_ml, double least_ml, double most_mmhg) {
    EXPECT_NEAR(found.most_ml, most_ml, 0.003 * most_ml);
    EXPECT_NEAR(found.least_ml, least_ml, 0.003 * least_ml);
    EXPECT_NEAR(found.most_kpa, most_mmhg * kMillimetreOfMercury, 0.003 * most_mmhg * kMillimetreOfMercury);
  };
  const HeartBeat beat = Regazzoni().beats(10, 800);
  expect(beat.cavities[0], 136.754, 66.966, 119.693);
  expect(beat.cavities[1], 181.556, 111.769, 25.056);
}

TEST(ClosedLoop, ConvergesWithTheStep) {
  const Regazzoni model;
  const double coarse = model.beats(1, 200).cavities[0].stroke_ml(),
               middle = model.beats(1, 400).cavities[0].stroke_ml(),
               fine = model.beats(1, 800).cavities[0].stroke_ml();
  EXPECT_NEAR((coarse - middle) / (middle - fine), 2, 0.3) << coarse << ' ' << middle << ' ' << fine;
}

/// The left ventricle of 75 beats a minute against the systemic Windkessel, and the right one.
struct Open {
  std::vector<VentricleLoad> loads{systemic_load(), pulmonary_load()};
  std::vector<Elastance> chambers{{0.33, 0.012, 10, 0.15, 0.3, 0.15}, {0.07, 0.007, 10, 0.15, 0.3, 0.15}};

  HeartBeat beats(int count) const {
    const VentricleLoads circulation(loads, 0.8);
    HeartState state{0, Eigen::Vector2d(10, 2), Eigen::Vector2d(100, 100), Eigen::Vector2d(1, 0.6)};
    HeartBeat last;
    for (int i = 0; i < count; ++i) {
      auto beat = beat_heart(circulation, chambers, 0.8, state, 800);
      EXPECT_TRUE(beat.ok()) << (beat.ok() ? "" : beat.error().message);
      last = *std::move(beat);
      state = last.end;
    }
    return last;
  }
};

TEST(Windkessel, HasExactDerivatives) {
  Open open;
  open.loads[1].outlet = regurgitant(open.loads[1].outlet, 0.05);
  const VentricleLoads circulation(open.loads, 0.8);
  for (const Eigen::Vector2d& kpa : kPressures)
    expect_exact_derivatives(circulation, 0.05, Eigen::Vector2d(11.689, 2.6), kpa);
}

TEST(Windkessel, RunsOffExponentially) {
  const VentricleLoads circulation({systemic_load()}, 0.8);
  Vector kpa = Vector::Constant(1, 12.0);
  const int steps = 4000;
  for (int i = 1; i <= steps; ++i) {
    const auto step =
        step_circulation(circulation, kpa, 0.4 * i / steps, 0.4 / steps, Vector::Constant(1, 1.0));
    ASSERT_TRUE(step.ok());
    kpa = step->states;
  }
  const Windkessel arteries;
  const double exact =
      0.7 + (12 - 0.7) * std::exp(-0.4 / (arteries.resistance_kpa_s_per_ml * arteries.compliance_ml_per_kpa));
  EXPECT_NEAR(kpa[0], exact, 1e-3);
}

TEST(Windkessel, ComesToALimitCycle) {
  const Open open;
  const HeartBeat before = open.beats(19), last = open.beats(20);
  for (std::size_t c = 0; c < 2; ++c) {
    EXPECT_NEAR(last.cavities[c].most_ml / before.cavities[c].most_ml, 1, 1e-3);
    EXPECT_GT(last.cavities[c].ejection_fraction(), 0.3);
    EXPECT_LT(last.cavities[c].ejection_fraction(), 0.8);
  }
}

/// Of the fifth beat in so many steps, for each joule of stroke work: what is lost in the valves, along the
/// aorta and on the way to the veins, what the blood keeps there, and what the arteries store, less what
/// comes with the blood from the atrium.
double use_of_work(const Open& open, int steps) {
  const VentricleLoad& load = open.loads[0];
  const VentricleLoads circulation({load}, 0.8);
  const std::vector<Elastance> chamber{open.chambers[0]};
  HeartState state{0, Vector::Constant(1, 10), Vector::Constant(1, 100), Vector::Constant(1, 1)};
  for (int i = 0; i < 4; ++i) state = beat_heart(circulation, chamber, 0.8, state, steps)->end;
  const double work_j = beat_heart(circulation, chamber, 0.8, state, steps)->cavities[0].stroke_work_j;
  EXPECT_GT(work_j, 0.5);
  const double step_s = 0.8 / steps, before_kpa = state.circulation[0];
  double used_mj = 0;
  for (int i = 0; i < steps; ++i) {
    const HeartState next = step_heart(circulation, chamber, 0.8, state, step_s).value();
    const double kpa = next.cavity_kpa[0], artery = next.circulation[0];
    const double atrium = atrial_kpa_at(load.atrium, next.time_s, 0.8);
    const double in = flow_through(load.inlet, atrium - kpa).ml_per_s;
    const double out = in - (next.cavity_ml[0] - state.cavity_ml[0]) / step_s;
    const double run_off = (artery - load.arteries.venous_kpa) / load.arteries.resistance_kpa_s_per_ml;
    used_mj += step_s * (out * (kpa - artery) + run_off * artery - in * kpa);
    state = next;
  }
  const double after_kpa = state.circulation[0];
  used_mj += load.arteries.compliance_ml_per_kpa / 2 * (after_kpa * after_kpa - before_kpa * before_kpa);
  return used_mj / 1000 / work_j;
}

TEST(Windkessel, UsesUpTheWorkOfTheHeart) {
  const Open open;
  const double coarse = use_of_work(open, 8000) - 1, fine = use_of_work(open, 32000) - 1;
  EXPECT_LT(std::abs(coarse), 1e-5);
  EXPECT_NEAR(coarse / fine, 4, 0.4);
}

TEST(Windkessel, PulmonaryRegurgitationDilatesTheRightVentricle) {
  Open open;
  const HeartBeat healthy = open.beats(20);
  open.loads[1].outlet = regurgitant(open.loads[1].outlet, 0.05);
  const HeartBeat leaking = open.beats(20);
  EXPECT_GT(leaking.cavities[1].most_ml, 1.05 * healthy.cavities[1].most_ml);
  EXPECT_GT(leaking.cavities[1].stroke_ml(), 1.05 * healthy.cavities[1].stroke_ml());
  EXPECT_NEAR(leaking.cavities[0].most_ml, healthy.cavities[0].most_ml, 1e-6);
}

TEST(Circulation, TellsWhereItDoesNotConverge) {
  const Regazzoni model;
  Vector states = model.heart.states;
  states[0] = std::nan("");
  const auto step = step_circulation(model.loop, states, 0.25, 1e-3, Eigen::Vector2d(1, 1));
  ASSERT_FALSE(step.ok());
  EXPECT_EQ(step.error().code, ErrorCode::kInternal);
  EXPECT_NE(step.error().message.find("no solution at 0.25 s"), std::string::npos) << step.error().message;
}

TEST(Circulation, ParametersOutOfRangeAreNamed) {
  const auto fault_of_load = [](const auto& change) {
    VentricleLoad load = systemic_load();
    change(load);
    const Status checked = check_ventricle_load(load, 0.8);
    return checked.ok() ? std::string("none") : checked.error().message;
  };
  EXPECT_EQ(fault_of_load([](VentricleLoad&) {}), "none");
  EXPECT_EQ(fault_of_load([](VentricleLoad& load) { load.arteries.impedance_kpa_s_per_ml = 0; }), "none");
  EXPECT_EQ(fault_of_load([](VentricleLoad& load) { load.arteries.compliance_ml_per_kpa = 0; }),
            "circulation, systemic_arteries.compliance_ml_per_kpa: found 0, expected a number > 0");
  EXPECT_EQ(fault_of_load([](VentricleLoad& load) { load.outlet.width_kpa = -1; }),
            "circulation, outlet.width_kpa: found -1, expected a number > 0");
  EXPECT_EQ(
      fault_of_load([](VentricleLoad& load) { load.inlet.closed_kpa_s_per_ml = 1e-4; }),
      "circulation, inlet.closed_kpa_s_per_ml: found 0.0001, expected at least open_kpa_s_per_ml, 0.001");
  EXPECT_EQ(fault_of_load([](VentricleLoad& load) { load.atrium.duration_s = 1; }),
            "circulation, atrium.duration_s: found 1, expected at most a beat, 0.8 s");
  const auto fault_of_loop = [](const auto& change) {
    ClosedLoopParams params = regazzoni_heart().loop;
    change(params);
    const Status checked = check_closed_loop(params);
    return checked.ok() ? std::string("none") : checked.error().message;
  };
  EXPECT_EQ(fault_of_loop([](ClosedLoopParams&) {}), "none");
  EXPECT_EQ(fault_of_loop([](ClosedLoopParams& loop) { loop.period_s = std::nan(""); }),
            "circulation, period_s: found nan, expected a number > 0");
  EXPECT_EQ(fault_of_loop([](ClosedLoopParams& loop) { loop.pulmonary_veins.inertance_kpa_s2_per_ml = 0; }),
            "circulation, pulmonary_veins.inertance_kpa_s2_per_ml: found 0, expected a number > 0");
  EXPECT_EQ(
      fault_of_loop([](ClosedLoopParams& loop) { loop.right_atrium.relaxation_s = 0.7; }),
      "circulation, right_atrium.contraction_s + relaxation_s: found 0.87, expected at most a beat, 0.8 s");
}

TEST(Circulation, SameBytesOnEveryPlatform) {
  const HeartBeat loop = Regazzoni().beats(1, 400), open = Open().beats(1);
  Sha256 sha;
  for (const HeartBeat* beat : {&loop, &open})
    for (const Vector* values : {&beat->end.circulation, &beat->end.cavity_ml, &beat->end.cavity_kpa})
      sha.update_values(values->data(), static_cast<std::size_t>(values->size()));
  EXPECT_EQ(sha.hex().substr(0, 16), "fa0103b0be6dc863");
}

}  // namespace
}  // namespace voxtet
