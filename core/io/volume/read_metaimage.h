// MetaImage (.mha, .mhd with its data file).
// Format: MetaIO documentation, Kitware, "MetaImage" and "Reference: tags of MetaImage".
#pragma once

#include <span>

#include "io/volume/read_volume.h"
#include "types/label_volume.h"
#include "types/result.h"

namespace voxtet {

/// Whether the content starts with a line "Key = Value".
bool looks_like_metaimage(std::span<const std::uint8_t> bytes);

/// NDims 3, or 4 with one frame; every integer type, MET_FLOAT, MET_DOUBLE; binary (zlib or gzip when
/// compressed) or ASCII. TransformMatrix, Offset and ElementSpacing give the affine in LPS, turned into RAS.
/// Defaults: identity, zero and one; BinaryData True. Unknown fields are allowed, as in MetaIO, unless they
/// are one character away from a field that decides where or what the voxels are. Data files in lists or
/// patterns, and intensity rescaling, are refused. Errors: kBadInput naming the field.
Result<LabelVolume> read_metaimage(const VolumeFile& file);

}  // namespace voxtet
