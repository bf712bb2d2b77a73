// Bytes of a NIfTI, NRRD or MetaImage file -> label volume. The format is found from the content.
#pragma once

#include <string>

#include "io/bytes/volume_file.h"
#include "types/label_volume.h"
#include "types/result.h"
#include "types/scalar_volume.h"

namespace voxtet {

/// Reads labels, affine (RAS, mm), and names and colours if the file has them. Strict: a truncated, damaged
/// or unsupported file is an error that names the file, the field, what was found and what was expected;
/// memory is only allocated once the header has been checked against the bytes that are there. Accepts .nii,
/// .nii.gz (NIfTI-1, NIfTI-2), .nrrd, .nhdr, .seg.nrrd, .mha, .mhd; refuses .hdr/.img pairs. Values must be
/// whole, 0 to 65535. Data longer than the header says are an error too. `warnings` gets a line for
/// everything in the file that the volume cannot hold, such as overlaps of segments; each line begins with
/// the file's name. Errors: kBadInput; kOutOfMemory for a valid file that is too large for this machine.
Result<LabelVolume> read_volume(const VolumeFile& file, std::vector<std::string>* warnings = nullptr);

/// Reads a scalar image, just as strictly. Accepts .nii and .nii.gz.
Result<ScalarVolume> read_scalar_volume(const VolumeFile& file);

/// Reads from disk; siblings are looked up in the same folder.
Result<LabelVolume> read_volume_file(const std::string& path, std::vector<std::string>* warnings = nullptr);

}  // namespace voxtet
