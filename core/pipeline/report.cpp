#include "pipeline/report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "base/digest.h"
#include "geometry/topology/compare_topology.h"
#include "pipeline/results/value_json.h"
#include "pipeline/simulation_report.h"
#include "pipeline/version/engine_version.h"

namespace voxtet {
namespace {

using nlohmann::json;

json distance_json(const DistanceSummary& d) {
  return {{"samples", d.samples},
          {"spacing_mm", d.spacing_mm},
          {"mean_mm", d.mean_mm},
          {"rms_mm", d.rms_mm},
          {"p95_mm", d.p95_mm},
          {"max_mm", d.max_mm},
          {"uncertainty_mm", d.uncertainty_mm}};
}

json metric_json(const MetricSummary& m) {
  return {{"name", m.name},
          {"title", m.title},
          {"unit", m.unit},
          {"elements", m.elements},
          {"count", m.count},
          {"min", m.min},
          {"p01", m.p01},
          {"p1", m.p1},
          {"p5", m.p5},
          {"median", m.median},
          {"p95", m.p95},
          {"p99", m.p99},
          {"max", m.max},
          {"mean", m.mean},
          {"sd", m.sd},
          {"histogram", {{"lo", m.histogram.lo}, {"hi", m.histogram.hi}, {"counts", m.histogram.counts}}},
          {"worst", m.worst}};
}

json topology_json(const TopologyComparison& topology) {
  const auto& [before, after, differences] = topology;
  std::map<Label, std::array<LabelTopology, 2>> rows;
  for (const LabelTopology& t : before.labels) rows[t.label][0] = t;
  for (const LabelTopology& t : after.labels) rows[t.label][1] = t;
  json labels = json::array(), texts = json::array();
  for (const auto& [label, row] : rows) {
    const auto& [b, a] = row;
    labels.push_back({{"label", label},
                      {"components", {b.components, a.components}},
                      {"cavities", {b.cavities, a.cavities}},
                      {"handles", {b.handles, a.handles}},
                      {"euler", {b.euler, a.euler}},
                      {"pinched_edges", a.pinched_edges},
                      {"pinched_points", a.pinched_points}});
  }
  for (const TopologyDifference& d : differences) texts.push_back(in_words(d));
  return {{"labels", labels},
          {"contacts", {{"before", before.contacts}, {"after", after.contacts}}},
          {"differences", texts}};
}

json fidelity_json(const QualityReport& report) {
  json labels = json::array();
  for (const LabelFidelity& f : report.labels)
    labels.push_back({{"label", f.label},
                      {"voxels", f.voxels},
                      {"tets", f.tets},
                      {"voxel_mm3", f.voxel_mm3},
                      {"mesh_mm3", f.mesh_mm3},
                      {"volume_error_percent", f.volume_error_percent},
                      {"dice", f.dice},
                      {"median_edge_mm", f.median_edge_mm},
                      {"target_edge_mm", f.target_edge_mm}});
  return {{"labels", labels},
          {"mesh_to_surface", distance_json(report.mesh_to_surface)},
          {"surface_to_mesh", distance_json(report.surface_to_mesh)},
          {"topology", topology_json(report.topology)}};
}

json layers_json(const std::vector<LayerCount>& counts) {
  const auto shares_json = [](const LayerShares& shares) {
    return json{{"area_mm2", shares.area_mm2}, {"exact", shares.exact}, {"at_least", shares.at_least}};
  };
  json out = json::array();
  for (const LayerCount& count : counts) {
    json places = json::array();
    for (const LayerPlace& place : count.places)
      places.push_back({{"area_mm2", place.area_mm2},
                        {"centre_mm", {place.centre_mm.x(), place.centre_mm.y(), place.centre_mm.z()}},
                        {"layers", {place.fewest, place.most}}});
    out.push_back({{"wall", count.wall},
                   {"target_layers", count.target_layers},
                   {"by_edges", shares_json(count.by_edges)},
                   {"by_lines", shares_json(count.by_lines)},
                   {"places", places}});
  }
  return out;
}

/// Volumes of a transferred label by three rules of giving it to tets, against its voxels.
json transfer_json(const LabelTransfer& found) {
  json labels = json::array();
  for (const TransferredLabel& l : found.labels) {
    const auto against_voxels = [&l](double mm3) {
      return json{{"mm3", mm3}, {"error_percent", 100 * (mm3 - l.voxel_mm3) / l.voxel_mm3}};
    };
    json entry{{"label", l.label},
               {"voxel_mm3", l.voxel_mm3},
               {"by_fraction", against_voxels(l.fraction_mm3)},
               {"by_centroid", against_voxels(l.centroid_mm3)},
               {"by_majority", against_voxels(l.majority_mm3)}};
    entry["by_centroid"]["dice"] = l.centroid_dice;
    entry["by_majority"]["dice"] = l.majority_dice;
    labels.push_back(std::move(entry));
  }
  return labels;
}

/// The smallest and largest target edge length within what is meshed. Of a large volume some hundred thousand
/// voxels are looked at: this is asked for with every edit of sizes.
json sizes_of_body(const LabelVolume& volume, const SizingField& sizing) {
  constexpr std::size_t kMostVoxels = 500'000;
  const int stride =
      1 + static_cast<int>(std::cbrt(static_cast<double>(volume.voxel_count()) / double{kMostVoxels}));
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (int k = 0; k < volume.size[2]; k += stride)
    for (int j = 0; j < volume.size[1]; j += stride)
      for (int i = 0; i < volume.size[0]; i += stride) {
        if (volume.at(i, j, k) == kBackground) continue;
        const double h = sizing.at(volume.to_mm(i, j, k));
        low = std::min(low, h);
        high = std::max(high, h);
      }
  return high > 0 ? json{{"min_mm", low}, {"max_mm", high}} : json::object();
}

}  // namespace

json volume_json(const Session& session) {
  const bool prepared = session.source_volume() != nullptr;
  json out = prepared ? volume_json(*session.source_volume(), session.source_digest())
                      : volume_json(*session.files().volume, session.files().digest);
  const Source& source = session.recipe().source;
  out["warnings"] = prepared ? session.record(Stage::kVolume).warnings : session.files().remarks.warnings;
  out["name"] = source.file ? source.file->name : source.inlined ? source.inlined->name : "phantom";
  if (const OpenedMesh* opened = session.opened_mesh())
    out["mesh"] = {{"points", opened->mesh.points.size()},
                   {"tets", opened->mesh.tets.size()},
                   {"fibres", !opened->fibres.fibre.empty()}};
  return out;
}

json stage_json(const Session& session, Stage stage) {
  const StageResult& result = *session.current(stage);
  json counts = stage == Stage::kVolume ? volume_json(session) : json::object();
  counts.update(spec_of(stage).counts(result.value));
  if (stage == Stage::kSizing) counts.update(sizes_of_body(*session.volume(), *session.sizing()));
  return {{"name", spec_of(stage).name},     {"seconds", result.record.seconds},
          {"cached", session.cached(stage)}, {"peak_mb", result.record.peak_mb},
          {"notes", result.record.notes},    {"counts", counts}};
}

json quality_json(const QualityReport& report) {
  json metrics = json::array(), checklist = json::array();
  for (const MetricSummary& m : report.metrics) metrics.push_back(metric_json(m));
  for (const ChecklistItem& item : report.checklist)
    checklist.push_back({{"name", item.name},
                         {"passed", item.passed},
                         {"hard", item.hard},
                         {"found", item.found},
                         {"expected", item.expected}});
  return {{"metrics", metrics}, {"checklist", checklist}, {"passed", report.passed()}};
}

json report_json(const Session& session) {
  json out{{"engine", engine_version()},
           {"recipe", recipe_to_json(session.recipe())},
           {"stages", json::array()},
           {"warnings", session.warnings()}};
  if (session.volume()) out["source"] = volume_json(session);
  for (const StageSpec& spec : stage_table()) {
    const StageResult* result = session.current(spec.stage);
    if (!result) continue;
    out["stages"].push_back(stage_json(session, spec.stage));
    const std::string digest = spec.digest ? spec.digest(result->value) : result->record.key;
    out["stages"].back()["digest"] = digest;
    if (spec.stage == Stage::kTetra || spec.stage == Stage::kOptimise) out["digest"] = digest;
  }
  if (session.mesh()) {
    out["tets"] = session.mesh()->tets.size();
    out["points"] = session.mesh()->points.size();
  }
  if (session.transfer() && !session.transfer()->labels.empty())
    out["transfer"] = transfer_json(*session.transfer());
  if (json simulation = simulation_json(session); !simulation.empty()) {
    out["simulation"] = std::move(simulation);
    out["physics"] = physics_version();
  }
  if (session.quality()) {
    out["quality"] = quality_json(*session.quality());
    if (session.smooth()) out["fidelity"] = fidelity_json(*session.quality());
    if (!session.quality()->layers.empty()) out["layers"] = layers_json(session.quality()->layers);
  }
  return out;
}

json schema_json() {
  json schema = recipe_schema();
  schema["stages"] = stages_schema();
  schema["version"] = engine_version();
  return schema;
}

json error_json(const Error& error) {
  json points = json::array();
  for (const Eigen::Vector3d& p : error.where.points) points.push_back({p.x(), p.y(), p.z()});
  return {{"code", to_string(error.code)},
          {"stage", error.stage},
          {"message", error.message},
          {"where",
           {{"points", points},
            {"elements", error.where.elements},
            {"stage", error.where.stage},
            {"on", name_of(error.where.on)}}}};
}

}  // namespace voxtet
