// NRRD (.nrrd, .nhdr with its data file) and 3D Slicer's segmentations in it (.seg.nrrd).
#pragma once

#include "io/volume/read_volume.h"
#include "types/label_volume.h"
#include "types/result.h"

namespace voxtet {

/// Three spatial axes; a fourth is either one frame, or the first axis and the layers of a segmentation,
/// which are flattened (see flatten_layers). Encodings raw, gzip and text; every scalar type; lengths in
/// `space units` (or `units`). Space RAS, LAS or LPS; a file without `space` is taken as LPS, as ITK does.
/// Without `space directions` the axes run along that space with `spacings` (1 mm where absent). Axis minima,
/// thicknesses and measurement frame do not move the image. A detached header that was cut exactly behind a
/// line cannot be told from a whole one unless a needed field is gone. `warnings` gets a line for each pair
/// of segments that overlap and each segment without voxels. Errors: kBadInput naming the field or segment.
Result<LabelVolume> read_nrrd(const VolumeFile& file, std::vector<std::string>& warnings);

}  // namespace voxtet
