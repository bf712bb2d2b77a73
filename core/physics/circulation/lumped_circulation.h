// Circulation as an ordinary differential equation, and its step in time: what a heart on a mesh, or one
// without, is coupled to through the pressures in its cavities.
#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "types/result.h"

namespace voxtet {

/// At one time; n states, m cavities of the heart. States are in ml, kPa and ml/s.
struct CirculationRates {
  Eigen::VectorXd states;              ///< n: d state / dt, 1/s
  Eigen::MatrixXd by_state;            ///< n x n: their derivatives
  Eigen::MatrixXd by_pressure;         ///< n x m, 1/kPa
  Eigen::VectorXd inflow_ml_per_s;     ///< m: into each cavity, through its inlet less through its outlet
  Eigen::MatrixXd inflow_by_state;     ///< m x n
  Eigen::MatrixXd inflow_by_pressure;  ///< m x m, ml/s/kPa
};

/// What is outside of the cavities: valves, vessels, atria.
class LumpedCirculation {
 public:
  virtual ~LumpedCirculation() = default;

  virtual std::vector<std::string_view> state_names() const = 0;
  virtual int cavities() const = 0;
  /// For the pressure in each cavity; derivatives are exact.
  virtual CirculationRates rates(double time_s, const Eigen::VectorXd& states,
                                 const Eigen::VectorXd& cavity_kpa) const = 0;
};

/// What a step comes to if the cavities have some pressures at its end.
struct CirculationStep {
  Eigen::VectorXd states;
  Eigen::VectorXd inflow_ml_per_s;  ///< at the end
  /// m x m, ml/s/kPa: how the inflow changes with the pressures, all that follows within the circulation
  /// included. A solver that has the cavities' volumes V and their pressures p as unknowns wants
  /// V(p) - V_before - step_s inflow(p) = 0, and here is the inflow's part of its tangent.
  Eigen::MatrixXd inflow_by_pressure;
};

/// A step of backward Euler to `end_s`, solved by Newton's method to rounding. Returns kInternal where it
/// does not converge, with the time.
Result<CirculationStep> step_circulation(const LumpedCirculation& circulation, const Eigen::VectorXd& states,
                                         double end_s, double step_s, const Eigen::VectorXd& cavity_kpa);

}  // namespace voxtet
