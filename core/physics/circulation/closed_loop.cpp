#include "physics/circulation/closed_loop.h"

#include <array>

namespace voxtet {
namespace {

constexpr double kMmHg = 0.133322387415;  ///< kPa

/// From numbers in mmHg, ml and s.
Elastance elastance_in_mmhg(double active, double passive, double unloaded_ml, double start_s,
                            double contraction_s, double relaxation_s) {
  return {active * kMmHg, passive * kMmHg, unloaded_ml, start_s, contraction_s, relaxation_s};
}
Vessels vessels_in_mmhg(double resistance, double compliance, double inertance) {
  return {resistance * kMmHg, compliance / kMmHg, inertance * kMmHg};
}

/// Writes rates and their derivatives; a flow from one place to another is added to both.
class LoopRates {
 public:
  LoopRates() {
    const Eigen::Index n = loop::kStates, m = 2;
    rates_ = {Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, m),
              Eigen::VectorXd::Zero(m), Eigen::MatrixXd::Zero(m, n), Eigen::MatrixXd::Zero(m, m)};
  }

  /// Through a valve between an atrium of this pressure, whose state is its volume, and a ventricle.
  void fill(const Valve& valve, loop::State atrium, double atrial_kpa, double elastance,
            Eigen::Index ventricle, double ventricle_kpa) {
    const auto [flow, slope] = flow_through(valve, atrial_kpa - ventricle_kpa);
    rates_.states[atrium] -= flow;
    rates_.by_state(atrium, atrium) -= slope * elastance;
    rates_.by_pressure(atrium, ventricle) += slope;
    rates_.inflow_ml_per_s[ventricle] += flow;
    rates_.inflow_by_state(ventricle, atrium) += slope * elastance;
    rates_.inflow_by_pressure(ventricle, ventricle) -= slope;
  }

  /// Through a valve from a ventricle into arteries.
  void eject(const Valve& valve, Eigen::Index ventricle, double ventricle_kpa, loop::State arteries,
             double arterial_kpa, double compliance) {
    const auto [flow, slope] = flow_through(valve, ventricle_kpa - arterial_kpa);
    rates_.inflow_ml_per_s[ventricle] -= flow;
    rates_.inflow_by_pressure(ventricle, ventricle) -= slope;
    rates_.inflow_by_state(ventricle, arteries) += slope;
    rates_.states[arteries] += flow / compliance;
    rates_.by_pressure(arteries, ventricle) += slope / compliance;
    rates_.by_state(arteries, arteries) -= slope / compliance;
  }

  /// From vessels on to a place whose pressure is `next_kpa` and changes with its state by `next_slope`, and
  /// whose state changes by the flow times `per_flow`.
  void flow_on(const Vessels& vessels, loop::State pressure, double kpa, loop::State flow_state, double flow,
               loop::State next, double next_kpa, double next_slope, double per_flow) {
    const double compliance = vessels.compliance_ml_per_kpa, inertance = vessels.inertance_kpa_s2_per_ml;
    rates_.states[pressure] -= flow / compliance;
    rates_.by_state(pressure, flow_state) -= 1 / compliance;
    rates_.states[next] += flow * per_flow;
    rates_.by_state(next, flow_state) += per_flow;
    rates_.states[flow_state] = (kpa - next_kpa - vessels.resistance_kpa_s_per_ml * flow) / inertance;
    rates_.by_state(flow_state, pressure) = 1 / inertance;
    rates_.by_state(flow_state, next) = -next_slope / inertance;
    rates_.by_state(flow_state, flow_state) = -vessels.resistance_kpa_s_per_ml / inertance;
  }

  CirculationRates take() && { return std::move(rates_); }

 private:
  CirculationRates rates_;
};

}  // namespace

std::vector<std::string_view> ClosedLoop::state_names() const {
  return {"left_atrium_ml",
          "right_atrium_ml",
          "systemic_arteries_kpa",
          "systemic_veins_kpa",
          "pulmonary_arteries_kpa",
          "pulmonary_veins_kpa",
          "systemic_arterial_flow_ml_per_s",
          "systemic_venous_flow_ml_per_s",
          "pulmonary_arterial_flow_ml_per_s",
          "pulmonary_venous_flow_ml_per_s"};
}

CirculationRates ClosedLoop::rates(double time_s, const Eigen::VectorXd& y,
                                   const Eigen::VectorXd& cavity_kpa) const {
  using namespace loop;
  const ClosedLoopParams& p = params_;
  const double left = elastance_at(p.left_atrium, time_s, p.period_s),
               right = elastance_at(p.right_atrium, time_s, p.period_s);
  const double left_kpa = left * (y[kLeftAtrium] - p.left_atrium.unloaded_ml),
               right_kpa = right * (y[kRightAtrium] - p.right_atrium.unloaded_ml);
  LoopRates rates;
  rates.fill(p.mitral, kLeftAtrium, left_kpa, left, 0, cavity_kpa[0]);
  rates.fill(p.tricuspid, kRightAtrium, right_kpa, right, 1, cavity_kpa[1]);
  rates.eject(p.aortic, 0, cavity_kpa[0], kSystemicArteries, y[kSystemicArteries],
              p.systemic_arteries.compliance_ml_per_kpa);
  rates.eject(p.pulmonary, 1, cavity_kpa[1], kPulmonaryArteries, y[kPulmonaryArteries],
              p.pulmonary_arteries.compliance_ml_per_kpa);
  rates.flow_on(p.systemic_arteries, kSystemicArteries, y[kSystemicArteries], kSystemicArterialFlow,
                y[kSystemicArterialFlow], kSystemicVeins, y[kSystemicVeins], 1,
                1 / p.systemic_veins.compliance_ml_per_kpa);
  rates.flow_on(p.systemic_veins, kSystemicVeins, y[kSystemicVeins], kSystemicVenousFlow,
                y[kSystemicVenousFlow], kRightAtrium, right_kpa, right, 1);
  rates.flow_on(p.pulmonary_arteries, kPulmonaryArteries, y[kPulmonaryArteries], kPulmonaryArterialFlow,
                y[kPulmonaryArterialFlow], kPulmonaryVeins, y[kPulmonaryVeins], 1,
                1 / p.pulmonary_veins.compliance_ml_per_kpa);
  rates.flow_on(p.pulmonary_veins, kPulmonaryVeins, y[kPulmonaryVeins], kPulmonaryVenousFlow,
                y[kPulmonaryVenousFlow], kLeftAtrium, left_kpa, left, 1);
  return std::move(rates).take();
}

double ClosedLoop::blood_ml(const Eigen::VectorXd& y) const {
  return y[loop::kLeftAtrium] + y[loop::kRightAtrium] +
         params_.systemic_arteries.compliance_ml_per_kpa * y[loop::kSystemicArteries] +
         params_.systemic_veins.compliance_ml_per_kpa * y[loop::kSystemicVeins] +
         params_.pulmonary_arteries.compliance_ml_per_kpa * y[loop::kPulmonaryArteries] +
         params_.pulmonary_veins.compliance_ml_per_kpa * y[loop::kPulmonaryVeins];
}

ClosedLoopHeart regazzoni_heart() {
  const Valve valve{0.0075 * kMmHg, 75006.2 * kMmHg, 0.01 * kMmHg};
  ClosedLoopHeart heart;
  heart.loop = {0.8,
                elastance_in_mmhg(0.07, 0.18, 4, 0.9, 0.17, 0.17),
                elastance_in_mmhg(0.06, 0.07, 4, 0.9, 0.17, 0.17),
                valve,
                valve,
                valve,
                valve,
                vessels_in_mmhg(0.733, 1.372, 5e-3),
                vessels_in_mmhg(0.32, 11.363, 5e-4),
                vessels_in_mmhg(0.046, 20, 5e-4),
                vessels_in_mmhg(0.0015, 16, 5e-4)};
  heart.left_ventricle = elastance_in_mmhg(4.482, 0.17, 42, 0.1, 0.25, 0.4);
  heart.right_ventricle = elastance_in_mmhg(0.2, 0.029, 16, 0.1, 0.25, 0.4);
  heart.states = Eigen::VectorXd(loop::kStates);
  heart.states << 87.183, 86.833, 87.675 * kMmHg, 35.898 * kMmHg, 19.545 * kMmHg, 15.004 * kMmHg, 71.104,
      94.039, 94.084, 473.279;
  heart.ventricles_ml = {118.52, 166.177};
  return heart;
}

}  // namespace voxtet
