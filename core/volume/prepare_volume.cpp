#include "volume/prepare_volume.h"

#include "types/stage_names.h"
#include "volume/interpolate_slices.h"
#include "volume/mesh_order.h"
#include "volume/remove_specks.h"

namespace voxtet {

Result<PreparedVolume> prepare_volume(const std::shared_ptr<const LabelVolume>& source,
                                      const std::vector<Label>& labels, const std::vector<LabelGroup>& merge,
                                      const VolumeParams& params, RunContext& ctx) {
  if (!(params.slice_ratio >= 0))
    return Error{ErrorCode::kUsage,
                 kVolumeStage,
                 "volume.slice_ratio: found " + std::to_string(params.slice_ratio) + ", expected 0 or more",
                 {}};
  Result<std::shared_ptr<const LabelVolume>> chosen = select_labels(source, labels, merge);
  if (!chosen) return chosen.error();
  PreparedVolume out{*chosen, *chosen, source};
  if (const AxisOrder order = mesh_order(*out.selected); !order.is_identity()) {
    out.anatomy = std::make_shared<const LabelVolume>(reordered(*source, order));
    out.selected = out.prepared =
        *chosen == source ? out.anatomy : std::make_shared<const LabelVolume>(reordered(**chosen, order));
  }
  if (has_thick_slices(*out.anatomy, params.slice_ratio)) {
    Result<LabelVolume> fine = interpolate_slices(*out.anatomy, params.slice_ratio, ctx);
    if (!fine) return fine.error();
    out.anatomy = std::make_shared<const LabelVolume>(std::move(fine).value());
    chosen = select_labels(out.anatomy, labels, merge);
    if (!chosen) return chosen.error();
    out.prepared = *chosen;
  }
  if (params.speck_voxels > 0 || params.hole_voxels > 0)
    out.prepared = std::make_shared<const LabelVolume>(
        remove_specks(*out.prepared, {params.speck_voxels, params.hole_voxels}, ctx));
  return out;
}

}  // namespace voxtet
