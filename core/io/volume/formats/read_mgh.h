// FreeSurfer's MGH (.mgh; .mgz through an inflating source).
// Format: FreeSurfer wiki, "MghFormat"; geometry: "CoordinateSystems" there.
#pragma once

#include <span>

#include "io/bytes/byte_source.h"
#include "io/volume/voxels/reading.h"
#include "types/label_volume.h"
#include "types/result.h"

namespace voxtet {

/// Whether `start` is the beginning of a header: version 1, a known type, extents above 0.
bool looks_like_mgh(std::span<const std::uint8_t> start);

/// Types uchar, short, ushort, int and float; several frames as in merge_frames.h; mm, or the unit of the
/// options. A file without a valid geometry is coronal with voxels of 1 mm, as FreeSurfer takes it. What
/// stands behind the voxels (acquisition, tags) is left out. Errors: kBadInput naming the field.
Result<LabelVolume> read_mgh(ByteSource& source, Reading& reading);

}  // namespace voxtet
