// Bytes of a NIfTI, NRRD, MetaImage or MGH file -> label volume. The format is found from the content.
#pragma once

#include <string>

#include "io/bytes/volume_file.h"
#include "types/label_volume.h"
#include "types/read_options.h"
#include "types/result.h"
#include "types/scalar_volume.h"

namespace voxtet {

/// Reads labels, affine (RAS, mm), and names and colours if the file has them. Strict: a truncated, damaged
/// or unsupported file is an error that names the file, the field, what was found, what was expected, and the
/// option that says what the file leaves open; memory is only allocated once the header has been checked
/// against the bytes that are there. Accepts .nii, .nii.gz (NIfTI-1, NIfTI-2), .nrrd, .nhdr, .seg.nrrd, .mha,
/// .mhd, .mgh, .mgz; refuses .hdr/.img pairs, and says of DICOM what to convert it with. What becomes of
/// values that are no labels: collect_labels.h; of several frames: merge_frames.h; of segments that overlap:
/// nrrd_segments.h. Data longer than the header says are an error too. `remarks` gets a line for everything
/// that the volume cannot hold or that is likely to be wrong, such as overlaps of segments; each line begins
/// with the file's name. Errors: kBadInput; kUsage for options that name what the file does not have;
/// kOutOfMemory for a valid file that is too large for this machine.
Result<LabelVolume> read_volume(const VolumeFile& file, const ReadOptions& options = {},
                                ReadRemarks* remarks = nullptr);

/// Reads a scalar image, just as strictly. Accepts .nii and .nii.gz.
Result<ScalarVolume> read_scalar_volume(const VolumeFile& file, ReadRemarks* remarks = nullptr);

/// Reads from disk; siblings are looked up in the same folder.
Result<LabelVolume> read_volume_file(const std::string& path, const ReadOptions& options = {},
                                     ReadRemarks* remarks = nullptr);

}  // namespace voxtet
