#include "physics/circulation/lumped_circulation.h"

#include <Eigen/LU>
#include <sstream>

namespace voxtet {

Result<CirculationStep> step_circulation(const LumpedCirculation& circulation, const Eigen::VectorXd& states,
                                         double end_s, double step_s, const Eigen::VectorXd& cavity_kpa) {
  constexpr int kMostIterations = 50;
  constexpr double kTolerance = 1e-11;  // of a state, or of 1 where it is less
  const Eigen::Index count = states.size();
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(count, count);
  CirculationStep step{states, {}, {}};
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    const CirculationRates rates = circulation.rates(end_s, step.states, cavity_kpa);
    const Eigen::PartialPivLU<Eigen::MatrixXd> tangent(identity - step_s * rates.by_state);
    const Eigen::VectorXd change = tangent.solve(states + step_s * rates.states - step.states);
    step.states += change;
    if (!((change.array().abs() <= kTolerance * step.states.array().abs().max(1)).all())) continue;
    const CirculationRates last = circulation.rates(end_s, step.states, cavity_kpa);
    const Eigen::MatrixXd moved = Eigen::PartialPivLU<Eigen::MatrixXd>(identity - step_s * last.by_state)
                                      .solve(step_s * last.by_pressure);
    step.inflow_ml_per_s = last.inflow_ml_per_s;
    step.inflow_by_pressure = last.inflow_by_pressure + last.inflow_by_state.lazyProduct(moved);
    return step;
  }
  std::ostringstream text;
  text << "circulation: found no solution at " << end_s << " s after " << kMostIterations
       << " iterations of Newton's method, expected one; a shorter step may help";
  return Error{ErrorCode::kInternal, "mechanics", text.str(), {}};
}

}  // namespace voxtet
