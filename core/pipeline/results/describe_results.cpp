#include "pipeline/results/describe_results.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "anatomy/facet_sets.h"
#include "pipeline/results/value_json.h"

namespace voxtet {

using nlohmann::json;

namespace {

/// What was moved, slice by slice.
json slices_json(const SliceAlignment& alignment) {
  json slices = json::array();
  for (const AlignedSlice& slice : alignment.slices)
    slices.push_back({{"slice", slice.move.slice},
                      {"move_mm", {slice.move.first_mm, slice.move.second_mm}},
                      {"given", slice.given},
                      {"dice_before", slice.overlap_before},
                      {"dice_after", slice.overlap_after}});
  return {{"axis", alignment.axis}, {"spread_mm", alignment.spread_mm}, {"slices", std::move(slices)}};
}

json flaws_json(const Flaws& flaws) {
  json out = json::array();
  for (const Flaw& flaw : flaws)
    out.push_back({{"kind", name_of(flaw.kind)},
                   {"count", flaw.count},
                   {"voxels", flaw.voxels},
                   {"largest", flaw.largest},
                   {"labels", flaw.labels},
                   {"text", in_words(flaw)}});
  return out;
}

/// What each plane of volume.cut took away.
json cut_json(const std::vector<CutRecord>& records) {
  json out = json::array();
  for (const CutRecord& record : records) {
    json labels = json::array();
    for (const auto& [label, voxels] : record.voxels)
      labels.push_back({{"label", label}, {"voxels", voxels}});
    out.push_back({{"name", record.name}, {"labels", std::move(labels)}});
  }
  return out;
}

/// Of each label the four largest contacts.
json surroundings_json(const std::vector<LabelSurroundings>& found) {
  constexpr std::size_t kMost = 4;
  json out = json::array();
  for (const LabelSurroundings& of : found) {
    json contacts = json::array();
    for (std::size_t n = 0; n < std::min(kMost, of.contacts.size()); ++n)
      contacts.push_back({{"label", of.contacts[n].other}, {"share", of.contacts[n].share}});
    out.push_back(
        {{"label", of.label}, {"contacts", std::move(contacts)}, {"border_share", of.border_share}});
  }
  return out;
}

}  // namespace

json counts_of(const VolumeResult& result) {
  json counts = volume_json(*result.source, result.digest);
  const LabelVolume& prepared = *result.prepared.prepared;
  const Eigen::Vector3d spacing = prepared.spacing_mm();
  counts["prepared"] = {{"size", prepared.size}, {"spacing_mm", {spacing.x(), spacing.y(), spacing.z()}}};
  if (!result.prepared.alignment.slices.empty()) counts["alignment"] = slices_json(result.prepared.alignment);
  if (!result.prepared.cut_away.empty()) counts["cut"] = cut_json(result.prepared.cut_away);
  counts["surroundings"] = surroundings_json(result.surroundings);
  counts["flaws"] = flaws_json(result.prepared.flaws);
  return counts;
}

json counts_of(const SurfaceMesh& surface) {
  return {{"points", surface.points.size()}, {"triangles", surface.triangles.size()}};
}

json counts_of(const TetMesh& mesh) {
  return {{"points", mesh.points.size()}, {"tets", mesh.tets.size()}, {"faces", mesh.faces.size()}};
}

json counts_of(const WallsResult& result) {
  return {{"walls", result.walls.size()}};
}

json counts_of(const SizingField& field) {
  const auto [low, high] = std::minmax_element(field.h_mm.begin(), field.h_mm.end());
  return {{"size", field.size},
          {"index_to_mm", matrix_json(field.index_to_mm)},
          {"min_mm", *low},
          {"max_mm", *high}};
}

json counts_of(const LayersResult& result) {
  return {{"walls", result.exact.size()}};
}

json counts_of(const LabelTransfer& found) {
  return {{"labels", found.labels.size()}};
}

json counts_of(const QualityReport&) {
  return json::object();
}

json counts_of(const AnatomyResult& result) {
  if (!result.surfaces) return json::object();
  json faces;
  for (const NamedSet& set : facet_sets(*result.surfaces)) faces[set.name] = set.members.size();
  return {{"surfaces", faces}};
}

json counts_of(const FibresResult& result) {
  const auto& fibres = result.fibres.fibre;
  return {{"tets", std::count_if(fibres.begin(), fibres.end(), [](const auto& f) { return !f.isZero(0); })}};
}

json counts_of(const TissueResult& result) {
  const Tissue& tissue = result.tissue;
  const auto conducts = [](std::uint16_t kind) { return kind != Tissue::kNone; };
  return {{"kinds", tissue.kinds.size()},
          {"conducting_tets", std::count_if(tissue.kind.begin(), tissue.kind.end(), conducts)}};
}

json counts_of(const EikonalResult& result) {
  float last = 0;
  for (const float time : result.fields[0].values) last = std::max(last, std::isnan(time) ? 0 : time);
  return {{"last_ms", last}};
}

json counts_of(const Trajectory& result) {
  return {{"frames", result.times_ms.size()}, {"end_ms", result.times_ms.back()}};
}

void add_arrays(const VolumeResult& result, StageArrays& out) {
  out.push_back({"labels", 1, std::span<const std::uint16_t>(result.source->labels)});
}

void add_arrays(const SizingField& field, StageArrays& out) {
  out.push_back({"h_mm", 1, std::span<const float>(field.h_mm),
                 Field{"h_mm", "Target edge length", "mm", On::kVoxels, Scale::kSequential, 1, {}}});
}

void add_arrays(const Trajectory& result, StageArrays& out) {
  add_arrays(result.last.fields, out);
  add_arrays(result.fields, out);
}

std::string digest_of(const VolumeResult& result) {
  return result.prepared.prepared == result.source ? result.digest : digest_of(*result.prepared.prepared);
}

std::string digest_of(const EikonalResult& result) {
  Sha256 digest;
  for (const Field& field : result.fields) digest.update_values(field.values.data(), field.values.size());
  return digest.hex();
}

std::string digest_of(const Trajectory& result) {
  return result.digest;
}

}  // namespace voxtet
