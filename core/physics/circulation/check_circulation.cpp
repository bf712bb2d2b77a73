#include "physics/circulation/check_circulation.h"

#include <cmath>
#include <optional>
#include <sstream>
#include <string>

namespace voxtet {
namespace {

/// Keeps the first fault.
class CirculationCheck {
 public:
  void positive(std::string_view group, const char* field, double found) {
    expect(found > 0, group, field, found, "a number > 0");
  }
  void not_negative(std::string_view group, const char* field, double found) {
    expect(found >= 0, group, field, found, "a number >= 0");
  }
  void finite(std::string_view group, const char* field, double found) {
    expect(true, group, field, found, "a finite number");
  }
  void within_beat(std::string_view group, const char* field, double found, double period_s) {
    expect(found <= period_s * (1 + 1e-9), group, field, found,
           "at most a beat, " + text_of(period_s) + " s");
  }

  void valve(std::string_view group, const Valve& valve) {
    positive(group, "open_kpa_s_per_ml", valve.open_kpa_s_per_ml);
    expect(valve.closed_kpa_s_per_ml >= valve.open_kpa_s_per_ml, group, "closed_kpa_s_per_ml",
           valve.closed_kpa_s_per_ml, "at least open_kpa_s_per_ml, " + text_of(valve.open_kpa_s_per_ml));
    positive(group, "width_kpa", valve.width_kpa);
  }
  void chamber(std::string_view group, const Elastance& chamber, double period_s) {
    not_negative(group, "active_kpa_per_ml", chamber.active_kpa_per_ml);
    positive(group, "passive_kpa_per_ml", chamber.passive_kpa_per_ml);
    finite(group, "unloaded_ml", chamber.unloaded_ml);
    finite(group, "start_s", chamber.start_s);
    positive(group, "contraction_s", chamber.contraction_s);
    positive(group, "relaxation_s", chamber.relaxation_s);
    within_beat(group, "contraction_s + relaxation_s", chamber.contraction_s + chamber.relaxation_s,
                period_s);
  }
  void vessels(std::string_view group, const Vessels& vessels) {
    positive(group, "resistance_kpa_s_per_ml", vessels.resistance_kpa_s_per_ml);
    positive(group, "compliance_ml_per_kpa", vessels.compliance_ml_per_kpa);
    positive(group, "inertance_kpa_s2_per_ml", vessels.inertance_kpa_s2_per_ml);
  }

  Status status() const {
    if (fault_) return usage_error("mechanics", *fault_);
    return std::monostate{};
  }

 private:
  static std::string text_of(double number) {
    std::ostringstream text;
    text << number;
    return text.str();
  }
  void expect(bool right, std::string_view group, const char* field, double found,
              const std::string& expected) {
    if (fault_ || (right && std::isfinite(found))) return;
    fault_ = "circulation, " + std::string(group) + (group.empty() ? "" : ".") + field + ": found " +
             text_of(found) + ", expected " + expected;
  }

  std::optional<std::string> fault_;
};

}  // namespace

Status check_ventricle_load(const VentricleLoad& load, double period_s) {
  CirculationCheck check;
  check.positive("", "period_s", period_s);
  check.finite("atrium", "rest_kpa", load.atrium.rest_kpa);
  check.finite("atrium", "kick_kpa", load.atrium.kick_kpa);
  check.finite("atrium", "start_s", load.atrium.start_s);
  check.positive("atrium", "duration_s", load.atrium.duration_s);
  check.within_beat("atrium", "duration_s", load.atrium.duration_s, period_s);
  check.valve("inlet", load.inlet);
  check.valve("outlet", load.outlet);
  const Windkessel& arteries = load.arteries;
  check.positive(arteries.name, "resistance_kpa_s_per_ml", arteries.resistance_kpa_s_per_ml);
  check.positive(arteries.name, "compliance_ml_per_kpa", arteries.compliance_ml_per_kpa);
  check.not_negative(arteries.name, "impedance_kpa_s_per_ml", arteries.impedance_kpa_s_per_ml);
  check.finite(arteries.name, "venous_kpa", arteries.venous_kpa);
  return check.status();
}

Status check_closed_loop(const ClosedLoopParams& params) {
  CirculationCheck check;
  check.positive("", "period_s", params.period_s);
  check.chamber("left_atrium", params.left_atrium, params.period_s);
  check.chamber("right_atrium", params.right_atrium, params.period_s);
  check.valve("mitral", params.mitral);
  check.valve("aortic", params.aortic);
  check.valve("tricuspid", params.tricuspid);
  check.valve("pulmonary", params.pulmonary);
  check.vessels("systemic_arteries", params.systemic_arteries);
  check.vessels("systemic_veins", params.systemic_veins);
  check.vessels("pulmonary_arteries", params.pulmonary_arteries);
  check.vessels("pulmonary_veins", params.pulmonary_veins);
  return check.status();
}

Status check_elastance(std::string_view name, const Elastance& chamber, double period_s) {
  CirculationCheck check;
  check.chamber(name, chamber, period_s);
  return check.status();
}

}  // namespace voxtet
