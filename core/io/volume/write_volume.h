// Label volume or scalar image -> NIfTI-1 bytes.
#pragma once

#include "io/bytes/bytes.h"
#include "types/label_volume.h"
#include "types/result.h"
#include "types/scalar_volume.h"

namespace voxtet {

/// NIfTI-1, uint8 when all labels fit, else uint16; sform and qform (where representable) hold the affine;
/// `gzip` compresses with no timestamp, so that equal volumes give equal bytes.
/// Errors: kUsage for sizes above 32767 per axis.
Result<Bytes> write_nifti(const LabelVolume& volume, bool gzip);

/// The same for a scalar image, float32.
Result<Bytes> write_nifti(const ScalarVolume& volume, bool gzip);

}  // namespace voxtet
