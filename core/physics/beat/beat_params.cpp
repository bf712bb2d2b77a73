#include "physics/beat/beat_params.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "physics/circulation/check_circulation.h"
#include "physics/mechanics/elements/body.h"

namespace voxtet {
namespace {

Status fault(const std::string& field, const std::string& what) {
  return usage_error(kMechanicsStage, "physics.mechanics." + field + ": " + what);
}

Status within(const std::string& field, double value, double least, double most) {
  if (value >= least && value <= most) return std::monostate{};
  return fault(field, "found " + std::to_string(value) + ", expected a number from " + std::to_string(least) +
                          " to " + std::to_string(most));
}

/// Whether one time is a multiple of another, but for rounding.
bool divides(double part_ms, double whole_ms) {
  const double times = whole_ms / part_ms;
  return std::abs(times - std::round(times)) < 1e-9 * times && times >= 0.5;
}

}  // namespace

mechanics::Material MuscleMaterial::chosen() const {
  if (holzapfel_ogden) return *holzapfel_ogden;
  if (guccione) return *guccione;
  if (mooney_rivlin) return *mooney_rivlin;
  if (corotational) return *corotational;
  return transversely_isotropic.value_or(mechanics::TransverselyIsotropic{});
}

LoopParams::LoopParams() : ClosedLoopParams(regazzoni_heart().loop) {
  left_atrium.start_s = right_atrium.start_s = 0;
}

Status check_beat_params(const BeatParams& p) {
  const int materials = p.material.transversely_isotropic.has_value() +
                        p.material.holzapfel_ogden.has_value() + p.material.guccione.has_value() +
                        p.material.mooney_rivlin.has_value() + p.material.corotational.has_value();
  if (materials > 1)
    return fault("material", "found " + std::to_string(materials) + " materials, expected at most one");
  if (const auto wrong = fault_of(p.material.chosen())) return fault("material", *wrong);
  std::vector<Label> seen;
  for (std::size_t i = 0; i < p.labels.size(); ++i) {
    const std::string at = "labels[" + std::to_string(i) + "]";
    if (p.labels[i].labels.empty()) return fault(at + ".labels", "found none, expected at least one label");
    for (const Label label : p.labels[i].labels) {
      if (std::find(seen.begin(), seen.end(), label) != seen.end())
        return fault(at + ".labels", "label " + std::to_string(label) + " has an entry before");
      seen.push_back(label);
    }
    if (Status checked = within(at + ".stiffness", p.labels[i].stiffness, 1e-3, 1e4); !checked)
      return checked;
    if (Status checked = within(at + ".contractility", p.labels[i].contractility, 0, 100); !checked)
      return checked;
  }
  for (const auto* law : {&p.contraction.lv, &p.contraction.rv})
    if (*law)
      if (Status checked = check_active_stress(**law); !checked) return checked;
  struct {
    const char* field;
    double value, least, most;
  } const ranges[] = {{"bulk_kpa", p.bulk_kpa, 1, 1e7},
                      {"period_ms", p.period_ms, 100, 1e5},
                      {"step_ms", p.step_ms, 0.01, 50},
                      {"fill_ms", p.fill_ms, p.step_ms, 1e5},
                      {"contraction.duration_ms", p.contraction.duration_ms, 1, p.period_ms}};
  for (const auto& range : ranges)
    if (Status checked = within(range.field, range.value, range.least, range.most); !checked) return checked;
  for (const auto& [field, value] : {std::pair{"period_ms", p.period_ms}, std::pair{"frame_ms", p.frame_ms},
                                     std::pair{"fill_ms", p.fill_ms}})
    if (!divides(p.step_ms, value))
      return fault(field, "found " + std::to_string(value) + ", expected a multiple of step_ms, " +
                              std::to_string(p.step_ms));
  const double period_s = p.period_ms / 1000;
  if (p.closed_loop) {
    ClosedLoopParams loop = *p.closed_loop;
    loop.period_s = period_s;
    return check_closed_loop(loop);
  }
  if (Status checked = check_ventricle_load(p.windkessel.systemic, period_s); !checked) return checked;
  return check_ventricle_load(p.windkessel.pulmonary, period_s);
}

}  // namespace voxtet
