#include "pipeline/simulation_report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "physics/tissue/conducting_points.h"
#include "pipeline/results/stage_arrays.h"

namespace voxtet {
namespace {

using nlohmann::json;

struct Finite {
  std::size_t count = 0;
  double sum = 0, smallest = std::numeric_limits<double>::infinity(), largest = 0;
};

Finite finite_of(const std::vector<float>& values) {
  Finite found;
  for (const float value : values) {
    if (!std::isfinite(value)) continue;
    ++found.count;
    found.sum += value;
    found.smallest = std::min(found.smallest, static_cast<double>(value));
    found.largest = std::max(found.largest, static_cast<double>(value));
  }
  return found;
}

/// When the last stimulus of all began; 0 without any.
double last_stimulus_ms(const std::vector<Stimulus>& stimuli, double end_ms) {
  double last = 0;
  for (const Stimulus& stimulus : stimuli)
    for (const double start : start_times_ms(stimulus))
      if (start < end_ms) last = std::max(last, start);
  return last;
}

/// Of each beat the part of the conducting points that has it, and its first and last activation.
json beats_json(const std::vector<Field>& fields, double conducting) {
  json beats = json::array();
  const Field* field = find_field(fields, "activation_ms");
  for (int next = 2; field; ++next) {
    const Finite times = finite_of(field->values);
    if (times.count > 0)
      beats.push_back({{"activated", static_cast<double>(times.count) / conducting},
                       {"first_ms", times.smallest},
                       {"last_ms", times.largest}});
    field = find_field(fields, "activation_" + std::to_string(next) + "_ms");
  }
  return beats;
}

json monodomain_json(const Trajectory& result, const Recipe& recipe, double conducting) {
  const auto values = [&](const char* name) { return finite_of(find_field(result.fields, name)->values); };
  const Finite activated = values("activation_ms"), durations = values("apd_ms"),
               last = values("last_activation_ms");
  const double end = result.times_ms.back();
  const double paced = last_stimulus_ms(recipe.physics->stimuli, end);
  json out{{"end_ms", end},
           {"frames", result.times_ms.size()},
           {"activated", static_cast<double>(activated.count) / conducting},
           {"total_activation_ms", activated.largest},
           {"most_activations", values("activations").largest},
           {"beats", beats_json(result.fields, conducting)},
           {"last_stimulus_ms", paced},
           {"last_activation_ms", last.largest},
           {"lasted_ms", std::max(0.0, last.largest - paced)}};
  if (durations.count > 0) out["mean_apd_ms"] = durations.sum / static_cast<double>(durations.count);
  if (!result.traces.empty()) {
    json traces = json::array();
    for (const Trace& trace : result.traces)
      traces.push_back({{"title", trace.title}, {"unit", trace.unit}, {"values", trace.values}});
    out["traces"] = {{"times_ms", result.trace_times_ms}, {"electrodes", traces}};
  }
  return out;
}

json mechanics_json(const MechanicsResult& result) {
  json beats = json::array();
  const char* const names[] = {"lv", "rv"};
  for (const std::vector<VentricleBeat>& beat : result.beats) {
    json of_beat = json::object();
    for (std::size_t c = 0; c < beat.size(); ++c)
      of_beat[names[c]] = {
          {"end_diastolic_ml", beat[c].most_ml}, {"end_systolic_ml", beat[c].least_ml},
          {"stroke_ml", beat[c].stroke_ml()},    {"ejection_fraction", beat[c].ejection_fraction()},
          {"most_kpa", beat[c].most_kpa},        {"stroke_work_j", beat[c].stroke_work_j}};
    beats.push_back(std::move(of_beat));
  }
  json lines = json::array();
  for (const Trace& trace : result.traces) lines.push_back(trace_json(trace));
  json out{{"end_ms", result.times_ms.back()},
           {"frames", result.times_ms.size()},
           {"beats", std::move(beats)},
           {"has_cycle", result.has_cycle},
           {"steps", result.steps},
           {"newton_iterations", result.newton_iterations},
           {"traces", {{"times_ms", result.trace_times_ms}, {"lines", std::move(lines)}}}};
  if (result.change_percent) out["change_percent"] = *result.change_percent;
  return out;
}

}  // namespace

json simulation_json(const Session& session) {
  json out = json::object();
  if (session.mechanics()) out["mechanics"] = mechanics_json(*session.mechanics());
  const TissueResult* found = session.result<TissueResult>(Stage::kTissue);
  if (!found) return out;
  const std::vector<bool> conducts = conducting_points(*session.mesh(), found->tissue);
  const auto conducting = static_cast<double>(std::count(conducts.begin(), conducts.end(), true));
  if (session.eikonal()) {
    const Finite times = finite_of(session.eikonal()->fields[0].values);
    out["eikonal"] = {{"last_ms", times.largest},
                      {"activated", static_cast<double>(times.count) / conducting}};
  }
  if (session.monodomain())
    out["monodomain"] = monodomain_json(*session.monodomain(), session.recipe(), conducting);
  return out;
}

}  // namespace voxtet
