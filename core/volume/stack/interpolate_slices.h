// Thick slices -> voxels about as long as wide, by shape-based interpolation of every label.
#pragma once

#include "types/label_volume.h"
#include "types/result.h"
#include "types/run_context.h"

namespace voxtet {

/// Whether the largest spacing is more than `ratio` times the smallest, by more than the thousandth that
/// headers round by; never for ratio 0.
bool has_thick_slices(const LabelVolume& volume, double ratio);

/// Resamples each axis whose spacing is more than `ratio` times the smallest one. Each slice becomes an odd
/// number of planes, at least three and as near as possible to the ratio of the spacings. The grid covers the
/// same space. The middle plane of a slice is the slice itself and keeps its labels; the half slices beyond
/// the outermost slices repeat them. Between slices all labels, background like any other, are interpolated
/// from their signed distances within the slices (see slice_gap.h). Then every label gets the volume of its
/// slices back by a constant offset of its outline, of at most a pixel; one that is never on three slices in
/// a row and is off by more than 3 % then fills the slabs of its slices instead. Labels that do not touch in
/// either of two slices are kept apart between them by a label that touches both. Small pieces of which no
/// slice has a part are absorbed. Shape-based interpolation: Raya and Udupa, IEEE Trans. Med. Imaging 9
/// (1990); Herman, Zheng, Bucholtz, IEEE Comput. Graph. Appl. 12 (1992). Notes: the grids, volume, components
/// and Euler number of the labels. Warnings: labels whose volume changes by more than 1 % or that fall into
/// more components. Errors: kCancelled; kOutOfMemory for more than 2^30 voxels. Linear time.
Result<LabelVolume> interpolate_slices(const LabelVolume& volume, double ratio, const RunContext& ctx);

}  // namespace voxtet
