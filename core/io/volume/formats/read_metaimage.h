// MetaImage (.mha, .mhd with its data files).
// Format: MetaIO documentation, Kitware, "MetaImage" and "Reference: tags of MetaImage".
#pragma once

#include <span>

#include "io/bytes/volume_file.h"
#include "io/volume/voxels/reading.h"
#include "types/label_volume.h"
#include "types/result.h"

namespace voxtet {

/// Whether the content starts with a line "Key = Value".
bool looks_like_metaimage(std::span<const std::uint8_t> bytes);

/// NDims 3, or 4 with frames (merge_frames.h), or several channels, which are frames too; every integer type,
/// MET_FLOAT, MET_DOUBLE; binary (zlib or gzip when compressed) or ASCII; in files of a LIST or a pattern
/// too. TransformMatrix, Offset and ElementSpacing give the affine in LPS, turned into RAS. Defaults:
/// identity, zero and one; BinaryData True. Intensity rescaling is refused. A wrong CompressedDataSize is
/// warned of where the data are whole. Errors: kBadInput naming the field.
Result<LabelVolume> read_metaimage(const VolumeFile& file, Reading& reading);

}  // namespace voxtet
