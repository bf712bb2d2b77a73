#include "pipeline/report.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>

#include "geometry/compare_topology.h"
#include "geometry/digest.h"
#include "volume/select_labels.h"

namespace voxtet {
namespace {

using nlohmann::json;

json matrix_json(const Eigen::Matrix4d& m) {
  json out = json::array();
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) out.push_back(m(row, column));
  return out;
}

json colour_json(const LabelInfo& info) {
  if (info.colour[0] < 0) return nullptr;
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", static_cast<unsigned>(info.colour[0] * 255 + 0.5F) & 255U,
                static_cast<unsigned>(info.colour[1] * 255 + 0.5F) & 255U,
                static_cast<unsigned>(info.colour[2] * 255 + 0.5F) & 255U);
  return text;
}

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
                      {"wished_edge_mm", f.wished_edge_mm}});
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
                   {"wished", count.wished},
                   {"by_edges", shares_json(count.by_edges)},
                   {"by_lines", shares_json(count.by_lines)},
                   {"places", places}});
  }
  return out;
}

/// Volumes of a looked-up label by three ways of giving it to tets, against its voxels.
json lookup_json(const LabelLookUp& found) {
  json labels = json::array();
  for (const LookedUpLabel& l : found.labels) {
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

json surface_counts(const SurfaceMesh& surface) {
  return {{"points", surface.points.size()}, {"triangles", surface.triangles.size()}};
}

json mesh_counts(const TetMesh& mesh) {
  return {{"points", mesh.points.size()}, {"tets", mesh.tets.size()}, {"faces", mesh.faces.size()}};
}

json counts_json(const Session& session, Stage stage) {
  switch (stage) {
    case Stage::kVolume: {
      json counts = volume_json(session);
      const Eigen::Vector3d spacing = session.volume()->spacing_mm();
      counts["prepared"] = {{"size", session.volume()->size},
                            {"spacing_mm", {spacing.x(), spacing.y(), spacing.z()}}};
      return counts;
    }
    case Stage::kSurface: return surface_counts(*session.surface());
    case Stage::kSmooth: return surface_counts(*session.smooth());
    case Stage::kRemesh: return surface_counts(*session.remeshed());
    case Stage::kSizing: {
      const SizingField& field = *session.sizing();
      const auto [low, high] = std::minmax_element(field.h_mm.begin(), field.h_mm.end());
      return {{"size", field.size},
              {"index_to_mm", matrix_json(field.index_to_mm)},
              {"min_mm", *low},
              {"max_mm", *high}};
    }
    case Stage::kTetra: return mesh_counts(*session.filled());
    case Stage::kOptimise: return mesh_counts(*session.mesh());
    case Stage::kLookup: return {{"labels", session.lookup()->labels.size()}};
    case Stage::kQuality: return json::object();
  }
  return json::object();
}

std::string result_digest(const Session& session, Stage stage) {
  switch (stage) {
    case Stage::kVolume:
      return session.volume() == session.source_volume() ? session.source_digest()
                                                         : digest_of(*session.volume());
    case Stage::kSurface: return digest_of(*session.surface());
    case Stage::kSmooth: return digest_of(*session.smooth());
    case Stage::kRemesh: return digest_of(*session.remeshed());
    case Stage::kTetra: return digest_of(*session.filled());
    case Stage::kOptimise: return digest_of(*session.mesh());
    default: return session.record(stage).key;
  }
}

}  // namespace

json volume_json(const Session& session) {
  const LabelVolume& volume = *session.source_volume();
  const Eigen::Vector3d spacing = volume.spacing_mm();
  json labels = json::array();
  for (const auto& [label, count] : count_labels(volume)) {
    json entry{
        {"label", label}, {"name", "label " + std::to_string(label)}, {"colour", nullptr}, {"voxels", count}};
    for (const LabelInfo& info : volume.infos) {
      if (info.label != label) continue;
      if (!info.name.empty()) entry["name"] = info.name;
      entry["colour"] = colour_json(info);
    }
    labels.push_back(std::move(entry));
  }
  const Source& source = session.recipe().source;
  return {{"name", source.file ? source.file->name : "phantom"},
          {"size", volume.size},
          {"spacing_mm", {spacing.x(), spacing.y(), spacing.z()}},
          {"index_to_mm", matrix_json(volume.index_to_mm)},
          {"digest", session.source_digest()},
          {"labels", labels},
          {"warnings", session.record(Stage::kVolume).warnings}};
}

json stage_json(const Session& session, Stage stage) {
  const StageRecord& record = session.record(stage);
  return {{"name", kStageNames[static_cast<std::size_t>(stage)]},
          {"seconds", record.seconds},
          {"cached", record.cached},
          {"peak_mb", record.peak_mb},
          {"notes", record.notes},
          {"counts", counts_json(session, stage)}};
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
  for (int i = 0; i < kStageCount; ++i) {
    const auto stage = static_cast<Stage>(i);
    if (session.record(stage).key.empty()) continue;
    out["stages"].push_back(stage_json(session, stage));
    const std::string digest = result_digest(session, stage);
    out["stages"].back()["digest"] = digest;
    if (stage == Stage::kTetra || stage == Stage::kOptimise) out["digest"] = digest;
  }
  if (session.mesh()) {
    out["tets"] = session.mesh()->tets.size();
    out["points"] = session.mesh()->points.size();
  }
  if (session.lookup() && !session.lookup()->labels.empty()) out["lookup"] = lookup_json(*session.lookup());
  if (session.quality()) {
    out["quality"] = quality_json(*session.quality());
    out["fidelity"] = fidelity_json(*session.quality());
    if (!session.quality()->layers.empty()) out["layers"] = layers_json(session.quality()->layers);
  }
  return out;
}

json error_json(const Error& error) {
  json points = json::array();
  for (const Eigen::Vector3d& p : error.where.points) points.push_back({p.x(), p.y(), p.z()});
  return {{"code", to_string(error.code)},
          {"stage", error.stage},
          {"message", error.message},
          {"where", {{"points", points}, {"elements", error.where.elements}}}};
}

}  // namespace voxtet
