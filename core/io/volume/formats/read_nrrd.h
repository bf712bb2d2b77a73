// NRRD (.nrrd, .nhdr with its data files) and 3D Slicer's segmentations in it (.seg.nrrd).
#pragma once

#include "io/bytes/volume_file.h"
#include "io/volume/voxels/reading.h"
#include "types/label_volume.h"
#include "types/result.h"

namespace voxtet {

/// Three spatial axes; a fourth is the first axis and the layers of a segmentation (read_segments), or the
/// first or the last and frames (merge_frames.h). Encodings raw, gzip and text; every scalar type; data
/// behind the header, in another file, or in files of a LIST or a pattern. Lengths in `space units` (or
/// `units`) of any spelling, or in the unit of the options. Space RAS, LAS or LPS; a file without `space` is
/// taken as LPS, as ITK does. Without `space directions` the axes run along that space with `spacings` (1 mm
/// where absent). Axis minima, thicknesses and measurement frame do not move the image. A detached header
/// that was cut exactly behind a line cannot be told from a whole one unless a needed field is gone. Errors:
/// kBadInput naming the field or segment; kUsage for a segment of ReadOptions::precedence that the file does
/// not have.
Result<LabelVolume> read_nrrd(const VolumeFile& file, Reading& reading);

}  // namespace voxtet
