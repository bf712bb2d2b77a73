#include "study/figures.h"

#include <algorithm>
#include <cmath>

#include "base/digest.h"
#include "pipeline/results/describe_results.h"
#include "pipeline/simulation_report.h"
#include "pipeline/version/engine_version.h"

namespace voxtet {
namespace {

using Json = nlohmann::ordered_json;

const MetricSummary* metric_of(const QualityReport& report, const std::string& name) {
  for (const MetricSummary& metric : report.metrics)
    if (metric.name == name) return &metric;
  return nullptr;
}

void add_quality(const QualityReport& report, bool has_labels, Json& out) {
  if (const MetricSummary* angle = metric_of(report, "min_dihedral_deg"))
    out["smallest_dihedral_deg"] = angle->min;
  if (const MetricSummary* angle = metric_of(report, "max_dihedral_deg"))
    out["largest_dihedral_deg"] = angle->max;
  if (const MetricSummary* ratio = metric_of(report, "mean_ratio")) out["median_mean_ratio"] = ratio->median;
  out["passed"] = report.passed();
  if (!has_labels) return;
  out["mean_distance_mm"] = std::max(report.mesh_to_surface.mean_mm, report.surface_to_mesh.mean_mm);
  out["largest_distance_mm"] = std::max(report.mesh_to_surface.max_mm, report.surface_to_mesh.max_mm);
  out["topology_differences"] = report.topology.differences.size();
  double worst = 0, least = 1;
  for (const LabelFidelity& label : report.labels) {
    if (std::abs(label.volume_error_percent) > std::abs(worst)) worst = label.volume_error_percent;
    least = std::min(least, label.dice);
  }
  out["worst_volume_error_percent"] = worst;
  out["least_dice"] = least;
}

void add_simulations(const Session& session, Json& out) {
  const nlohmann::json found = simulation_json(session);
  const auto take = [&](const char* column, const char* pointer) {
    const nlohmann::json::json_pointer at(pointer);
    if (found.contains(at)) out[column] = found[at];
  };
  take("eikonal_activated", "/eikonal/activated");
  take("eikonal_last_ms", "/eikonal/last_ms");
  take("monodomain_activated", "/monodomain/activated");
  take("monodomain_last_ms", "/monodomain/total_activation_ms");
  const std::size_t beats = session.mechanics() ? session.mechanics()->beats.size() : 0;
  if (beats == 0) return;
  const std::string last = "/mechanics/beats/" + std::to_string(beats - 1);
  take("lv_ejection_fraction", (last + "/lv/ejection_fraction").c_str());
  take("rv_ejection_fraction", (last + "/rv/ejection_fraction").c_str());
}

}  // namespace

Expected promise_of(const Session& session) {
  Expected promise{.engine = engine_version()};
  if (!session.mesh()) return promise;
  promise.digest = digest_of(*session.mesh());
  promise.tets = static_cast<std::uint32_t>(session.mesh()->tets.size());
  if (session.eikonal()) promise.stages.eikonal = digest_of(*session.eikonal());
  if (session.monodomain()) promise.stages.monodomain = digest_of(*session.monodomain());
  if (session.mechanics()) promise.stages.mechanics = digest_of(*session.mechanics());
  if (session.eikonal() || session.monodomain() || session.mechanics()) promise.physics = physics_version();
  return promise;
}

Json no_figures() {
  Json out;
  for (const char* column : kFigures) out[column] = nullptr;
  return out;
}

Json figures_of(const Session& session) {
  Json out = no_figures();
  if (session.mesh()) {
    out["tets"] = session.mesh()->tets.size();
    out["points"] = session.mesh()->points.size();
  }
  out["warnings"] = session.warnings().size();
  if (session.quality()) add_quality(*session.quality(), session.smooth() != nullptr, out);
  add_simulations(session, out);
  const auto [engine, digest, tets, physics, stages] = promise_of(session);
  const auto put = [&](const char* column, const std::string& text) {
    if (!text.empty()) out[column] = text;
  };
  put("mesh_digest", digest);
  put("eikonal_digest", stages.eikonal);
  put("monodomain_digest", stages.monodomain);
  put("mechanics_digest", stages.mechanics);
  return out;
}

}  // namespace voxtet
