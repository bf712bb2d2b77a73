#include "physics/circulation/windkessel.h"

#include "base/portable_trig.h"
#include "physics/circulation/elastance.h"

namespace voxtet {

VentricleLoad systemic_load() {
  return {};
}

VentricleLoad pulmonary_load() {
  VentricleLoad load;
  load.atrium.rest_kpa = 0.5;
  load.atrium.kick_kpa = 0.9;
  load.arteries = {"pulmonary_arteries", 0.02, 30, 0.003, 0.7};
  return load;
}

double atrial_kpa_at(const AtrialPressure& atrium, double time_s, double period_s) {
  const double half = atrium.duration_s / 2;
  return elastance_at({atrium.kick_kpa - atrium.rest_kpa, atrium.rest_kpa, 0, atrium.start_s, half, half},
                      time_s, period_s);
}

std::vector<std::string_view> VentricleLoads::state_names() const {
  std::vector<std::string_view> names;
  for (const VentricleLoad& load : loads_) names.push_back(load.arteries.name);
  return names;
}

CirculationRates VentricleLoads::rates(double time_s, const Eigen::VectorXd& states,
                                       const Eigen::VectorXd& cavity_kpa) const {
  const auto count = static_cast<Eigen::Index>(loads_.size());
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(count, count);
  CirculationRates rates{Eigen::VectorXd::Zero(count), none, none, Eigen::VectorXd::Zero(count), none, none};
  for (Eigen::Index v = 0; v < count; ++v) {
    const VentricleLoad& load = loads_[static_cast<std::size_t>(v)];
    const Windkessel& arteries = load.arteries;
    // The impedance is in series with the valve.
    Valve outlet = load.outlet;
    outlet.open_kpa_s_per_ml += arteries.impedance_kpa_s_per_ml;
    outlet.closed_kpa_s_per_ml += arteries.impedance_kpa_s_per_ml;
    const auto [in, in_slope] =
        flow_through(load.inlet, atrial_kpa_at(load.atrium, time_s, period_s_) - cavity_kpa[v]);
    const auto [out, out_slope] = flow_through(outlet, cavity_kpa[v] - states[v]);
    const double run_off = (states[v] - arteries.venous_kpa) / arteries.resistance_kpa_s_per_ml;
    rates.states[v] = (out - run_off) / arteries.compliance_ml_per_kpa;
    rates.by_state(v, v) =
        -(out_slope + 1 / arteries.resistance_kpa_s_per_ml) / arteries.compliance_ml_per_kpa;
    rates.by_pressure(v, v) = out_slope / arteries.compliance_ml_per_kpa;
    rates.inflow_ml_per_s[v] = in - out;
    rates.inflow_by_state(v, v) = out_slope;
    rates.inflow_by_pressure(v, v) = -in_slope - out_slope;
  }
  return rates;
}

}  // namespace voxtet
