// Ventricles that each fill from an atrium of given pressure and eject into a Windkessel: an open
// circulation. Westerhof, Lankhaar and Westerhof, "The arterial Windkessel", Medical & Biological Engineering
// & Computing 47 (2009).
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "physics/circulation/lumped_circulation.h"
#include "physics/circulation/valve.h"

namespace voxtet {

/// C dp/dt = Q - (p - venous) / R within, and p + Z Q at the valve: two elements with Z = 0, else three.
struct Windkessel {
  std::string_view name = "systemic_arteries";
  double resistance_kpa_s_per_ml = 0.14;
  double compliance_ml_per_kpa = 11;
  double impedance_kpa_s_per_ml = 0.007;  ///< Z, of the aorta or the pulmonary artery
  double venous_kpa = 0.7;
};

/// A pressure at rest, and a wave up to `kick_kpa` and back, (1 - cos) / 2, as the atrium contracts.
struct AtrialPressure {
  double rest_kpa = 1;
  double kick_kpa = 1.6;
  double start_s = 0;
  double duration_s = 0.12;
};

struct VentricleLoad {
  AtrialPressure atrium;
  Valve inlet, outlet;
  Windkessel arteries;
};

/// Of the left ventricle, and of the right one: 0.5 to 0.9 kPa in its atrium, R 0.02, C 30, Z 0.003.
VentricleLoad systemic_load();
VentricleLoad pulmonary_load();

/// A state for each ventricle: the pressure within its Windkessel, kPa, under the Windkessel's name.
class VentricleLoads : public LumpedCirculation {
 public:
  VentricleLoads(std::vector<VentricleLoad> loads, double period_s)
      : loads_(std::move(loads)), period_s_(period_s) {}

  std::vector<std::string_view> state_names() const override;
  int cavities() const override { return static_cast<int>(loads_.size()); }
  CirculationRates rates(double time_s, const Eigen::VectorXd& states,
                         const Eigen::VectorXd& cavity_kpa) const override;

 private:
  std::vector<VentricleLoad> loads_;
  double period_s_;
};

/// kPa.
double atrial_kpa_at(const AtrialPressure& atrium, double time_s, double period_s);

}  // namespace voxtet
