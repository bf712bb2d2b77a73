// NIfTI-1 and NIfTI-2 in a single file (.nii; .nii.gz through an inflating source).
// Formats: R. W. Cox et al., "A (sort of) new image data format standard: NIfTI-1" (2004), nifti1.h;
// M. Jenkinson and others, nifti2.h (2011).
#pragma once

#include <span>

#include "io/bytes/byte_source.h"
#include "io/volume/voxels/reading.h"
#include "types/label_volume.h"
#include "types/result.h"
#include "types/scalar_volume.h"

namespace voxtet {

/// Size of the longer (NIfTI-2) header: `looks_like_nifti` needs as many bytes, if the file has them.
inline constexpr std::size_t kNiftiHeaderBytes = 540;

/// Whether `start` carries the header size or the magic of NIfTI (of ANALYZE too), in either byte order.
bool looks_like_nifti(std::span<const std::uint8_t> start);

/// Three dimensions, or more of extent 1, of which one may hold frames (merge_frames.h). The affine is that
/// of nifti_affine(). Labels are scl_slope * stored + scl_inter unless the slope is 0 or not finite. Header
/// extensions are skipped. Data that are longer than the header says are an error, like shorter ones. Pairs
/// of .hdr and .img, complex, RGB and 128-bit voxels are refused. Errors: kBadInput naming the header field.
Result<LabelVolume> read_nifti(ByteSource& source, Reading& reading);

/// The same for a scalar image of one frame.
Result<ScalarVolume> read_nifti_scalars(ByteSource& source, Reading& reading);

}  // namespace voxtet
