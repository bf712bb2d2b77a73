#include "volume/prepare_volume.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "types/stage_names.h"
#include "volume/extend_cuts.h"
#include "volume/mesh_order.h"
#include "volume/stack/interpolate_slices.h"

namespace voxtet {
namespace {

constexpr const char* kCleanRemedy = "; noise? --clean takes it away";

std::shared_ptr<const LabelVolume> share(LabelVolume volume) {
  return std::make_shared<const LabelVolume>(std::move(volume));
}

void extend_body(PreparedVolume& out, RunContext& ctx) {
  const LabelVolume& body = *out.prepared;
  const CutFaces faces = find_cut_faces(body);
  if (faces.none()) return;
  out.cuts = planes_of(body, faces, *std::max_element(body.labels.begin(), body.labels.end()));
  if (out.cuts.empty()) {
    ctx.warn(kVolumeStage,
             "volume.flat_border: the image cuts the body off, and its labels leave no numbers up to 65535 "
             "for the faces there: they are rounded; give the labels lower numbers");
    return;
  }
  std::string names;
  for (const CutPlane& cut : out.cuts) names += (names.empty() ? "" : ", ") + cut.name;
  ctx.note(kVolumeStage, "the image cuts the body off: flat faces " + names);
  const bool same = out.anatomy == out.prepared;
  out.meshed = share(extended(body, faces, &out.cuts));
  out.anatomy = share(extended(*out.anatomy, faces, nullptr, !same));
  out.prepared = same ? out.anatomy : share(extended(body, faces));
}

/// The body without what planes take away.
Status cut_body(PreparedVolume& out, const VolumeParams& params, RunContext& ctx) {
  Result<CutPlanes> planes = planes_given(params.cut, *out.prepared);
  if (!planes) return planes.error();
  Result<std::vector<CutRecord>> counted = count_cut(*out.selected, *planes, ctx);
  if (!counted) return counted.error();
  out.cut_away = std::move(counted).value();
  CutPlanes cutting;
  for (std::size_t c = 0; c < planes->size(); ++c)
    if (!out.cut_away[c].voxels.empty()) cutting.push_back((*planes)[c]);
  out.meshed = out.prepared;
  if (params.flat_border) extend_body(out, ctx);
  out.extracted = out.meshed;
  if (cutting.empty()) return std::monostate{};
  Label next = out.cuts.empty() ? std::numeric_limits<Label>::max() : out.cuts.back().beyond - 1;
  const Label of_body = *std::max_element(out.prepared->labels.begin(), out.prepared->labels.end());
  for (CutPlane& plane : cutting) plane.beyond = next--;
  if (next < of_body)
    return usage_error(kVolumeStage, "volume.cut: found the label " + std::to_string(of_body) +
                                         ", expected lower ones: numbers up to 65535 are needed for faces");
  out.meshed = share(with_beyond(*out.extracted, cutting));
  out.prepared = share(without_cut(*out.prepared, cutting));
  out.divided_mm3 = divided_mm3(*out.selected, cutting);
  out.selected = share(without_cut(*out.selected, cutting));
  out.cuts.insert(out.cuts.end(), cutting.begin(), cutting.end());
  return std::monostate{};
}

void clean_labels(PreparedVolume& out, const CleanLimits& limits, RunContext& ctx) {
  auto cleaned = std::make_shared<LabelVolume>(*out.prepared);
  for (const Flaw& flaw : clean_volume(*cleaned, limits))
    ctx.note(kVolumeStage, "cleaned: " + in_words(flaw));
  // What was taken away on purpose is nothing that the mesh lacks.
  if (out.selected == out.prepared) out.selected = cleaned;
  out.prepared = std::move(cleaned);
}

}  // namespace

Result<PreparedVolume> prepare_volume(const std::shared_ptr<const LabelVolume>& source,
                                      const std::vector<Label>& labels, const std::vector<LabelGroup>& merge,
                                      const VolumeParams& params, RunContext& ctx) {
  if (!(params.slice_ratio >= 0))
    return Error{ErrorCode::kUsage,
                 kVolumeStage,
                 "volume.slice_ratio: found " + std::to_string(params.slice_ratio) + ", expected 0 or more",
                 {}};
  Result<AlignedVolume> aligned = align_slices(source, params.align, params.slice_ratio, ctx);
  if (!aligned) return aligned.error();
  const std::shared_ptr<const LabelVolume>& placed = aligned->volume;
  Result<std::shared_ptr<const LabelVolume>> chosen = select_labels(placed, labels, merge);
  if (!chosen) return chosen.error();
  PreparedVolume out;
  out.selected = out.prepared = *chosen;
  out.anatomy = out.placed = placed;
  out.alignment = std::move(aligned->alignment);
  if (const AxisOrder order = mesh_order(*out.selected); !order.is_identity()) {
    out.anatomy = std::make_shared<const LabelVolume>(reordered(*placed, order));
    out.selected = out.prepared =
        *chosen == placed ? out.anatomy : std::make_shared<const LabelVolume>(reordered(**chosen, order));
  }
  if (has_thick_slices(*out.anatomy, params.slice_ratio)) {
    Result<LabelVolume> fine = interpolate_slices(*out.anatomy, params.slice_ratio, ctx);
    if (!fine) return fine.error();
    for (std::size_t d = 0; d < 3; ++d) out.planes[d] = fine->size[d] / out.anatomy->size[d];
    out.anatomy = std::make_shared<const LabelVolume>(std::move(fine).value());
    chosen = select_labels(out.anatomy, labels, merge);
    if (!chosen) return chosen.error();
    out.prepared = *chosen;
  }
  const CleanLimits limits{params.speck_voxels, params.hole_voxels, params.handle_voxels};
  if (!limits.none()) clean_labels(out, limits, ctx);
  out.flaws = find_flaws(*out.prepared);
  for (const Flaw& flaw : out.flaws) ctx.warn(kVolumeStage, in_words(flaw) + kCleanRemedy);
  if (const Status cut = cut_body(out, params, ctx); !cut) return cut.error();
  return out;
}

}  // namespace voxtet
