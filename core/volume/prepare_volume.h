// The volume as it was read -> the volume to be meshed.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "geometry/cut/cut_plane.h"
#include "types/label_volume.h"
#include "types/result.h"
#include "types/run_context.h"
#include "volume/clean/clean_volume.h"
#include "volume/cut_labels.h"
#include "volume/select_labels.h"
#include "volume/stack/align_slices.h"

namespace voxtet {

/// Sizes count voxels of the prepared grid, after interpolation.
struct VolumeParams {
  double slice_ratio = 2;           ///< slices thicker than so many pixels are interpolated; 0: never
  std::uint32_t speck_voxels = 0;   ///< smaller components of a label are removed, but its largest; 0: none
  std::uint32_t hole_voxels = 0;    ///< smaller enclosed components of background are removed; 0: none
  std::uint32_t handle_voxels = 0;  ///< smaller handles, tunnels and pits are mended; 0: none
  bool flat_border = true;          ///< faces at which the image cuts a body off are flat, with a sharp rim
  std::vector<CutParams> cut;       ///< planes at which labels are cut off
  AlignParams align;                ///< of slices that are shifted against each other
};

/// `placed` is the source with its slices where they belong (align_slices.h), which all else is made of.
/// `selected` and `prepared` hold the labels to be meshed: `selected` on the source's voxels, `prepared` on
/// those to be meshed. They are the same object if nothing was interpolated or added. `anatomy`
/// holds all labels on the grid of `prepared`. Where the image cuts a body off, both go on beyond its border,
/// and `meshed` is `prepared` with the labels `beyond` of `cuts` there; else the two are the same. What
/// planes of volume.cut take away is in neither `selected` nor `prepared`; in `meshed` it has labels `beyond`
/// near the plane, and in `extracted` its own ones everywhere, so that the surface passes through the plane:
/// `extracted` is `meshed` where there are no such planes. All are stored in the order of mesh_order(), and
/// are the source itself if nothing changes it.
struct PreparedVolume {
  std::shared_ptr<const LabelVolume> selected, prepared, anatomy, meshed, placed, extracted;
  CutPlanes cuts;                       ///< those of the border come first
  std::vector<CutRecord> cut_away;      ///< by volume.cut
  std::map<Label, double> divided_mm3;  ///< more of a label than its voxels in `selected` (cut_labels.h)
  SliceAlignment alignment;
  std::array<int, 3> planes{1, 1, 1};  ///< of `prepared` to each slice, along its axes
  Flaws flaws;  ///< of the labels as they are to be meshed: what usual cleaning would mend
};

/// Applies align_slices, select_labels and reordered, interpolate_slices to all labels, then clean_volume and
/// extend_cuts; what they did is noted in `ctx`, and flaws that are left are warned of. Errors: those of
/// align_slices, select_labels, planes_given and count_cut; kUsage for parameters out of range; kCancelled.
Result<PreparedVolume> prepare_volume(const std::shared_ptr<const LabelVolume>& source,
                                      const std::vector<Label>& labels, const std::vector<LabelGroup>& merge,
                                      const VolumeParams& params, RunContext& ctx);

}  // namespace voxtet
