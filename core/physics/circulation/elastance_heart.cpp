#include "physics/circulation/elastance_heart.h"

#include <Eigen/LU>
#include <algorithm>
#include <sstream>
#include <utility>

namespace voxtet {

Result<HeartState> step_heart(const LumpedCirculation& circulation, const std::vector<Elastance>& chambers,
                              double period_s, const HeartState& state, double step_s) {
  constexpr int kMostIterations = 50;
  constexpr double kTolerance = 1e-11;  // of a volume, or of 1 ml where it is less
  const double end_s = state.time_s + step_s;
  const Eigen::Index count = state.cavity_ml.size();
  Eigen::VectorXd compliance(count), unloaded(count), kpa = state.cavity_kpa;
  for (Eigen::Index c = 0; c < count; ++c) {
    const Elastance& chamber = chambers[static_cast<std::size_t>(c)];
    compliance[c] = 1 / elastance_at(chamber, end_s, period_s);
    unloaded[c] = chamber.unloaded_ml;
  }
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    auto step = step_circulation(circulation, state.circulation, end_s, step_s, kpa);
    if (!step) return step.error();
    // What flowed, not what the pressures make of it, so that no blood is lost.
    const Eigen::VectorXd ml = state.cavity_ml + step_s * step->inflow_ml_per_s;
    const Eigen::VectorXd missing = ml - unloaded - compliance.cwiseProduct(kpa);
    if ((missing.array().abs() <= kTolerance * ml.array().abs().max(1)).all())
      return HeartState{end_s, std::move(step->states), ml, kpa};
    Eigen::MatrixXd tangent = -step_s * step->inflow_by_pressure;
    tangent.diagonal() += compliance;
    kpa += Eigen::PartialPivLU<Eigen::MatrixXd>(tangent).solve(missing);
  }
  std::ostringstream text;
  text << "circulation: found no pressures in the cavities at " << end_s << " s after " << kMostIterations
       << " iterations of Newton's method, expected some; a shorter step may help";
  return Error{ErrorCode::kInternal, "mechanics", text.str(), {}};
}

Result<HeartBeat> beat_heart(const LumpedCirculation& circulation, const std::vector<Elastance>& chambers,
                             double period_s, const HeartState& state, int steps) {
  HeartBeat beat{state, {}};
  for (Eigen::Index c = 0; c < state.cavity_ml.size(); ++c)
    beat.cavities.push_back(VentricleBeat::from(state.cavity_ml[c], state.cavity_kpa[c]));
  for (int step = 0; step < steps; ++step) {
    auto next = step_heart(circulation, chambers, period_s, beat.end, period_s / steps);
    if (!next) return next.error();
    for (std::size_t c = 0; c < chambers.size(); ++c) {
      const auto i = static_cast<Eigen::Index>(c);
      beat.cavities[c].add(beat.end.cavity_ml[i], beat.end.cavity_kpa[i], next->cavity_ml[i],
                           next->cavity_kpa[i]);
    }
    beat.end = *std::move(next);
  }
  return beat;
}

HeartState start_of(const ClosedLoopHeart& heart) {
  HeartState state{0, heart.states, heart.ventricles_ml, Eigen::Vector2d::Zero()};
  const Elastance* const chambers[] = {&heart.left_ventricle, &heart.right_ventricle};
  for (Eigen::Index c = 0; c < 2; ++c)
    state.cavity_kpa[c] =
        elastance_at(*chambers[c], 0, heart.loop.period_s) * (state.cavity_ml[c] - chambers[c]->unloaded_ml);
  return state;
}

}  // namespace voxtet
