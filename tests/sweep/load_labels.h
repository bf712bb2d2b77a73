// A session's way to a volume made in memory, as if its file had been dropped.
#pragma once

#include "io/volume/write_volume.h"
#include "pipeline/session.h"

namespace voxtet::sweep {

inline constexpr const char* kNotThere = "the volume is not there: set VOXTET_DATA";

/// The affine is rounded to single precision, as NIfTI stores it.
inline Status load_labels(const LabelVolume& volume, Session& session) {
  const Result<Bytes> file = write_nifti(volume, false);
  if (!file) return file.error();
  return session.load_volume({"volume.nii", *file, {}});
}

}  // namespace voxtet::sweep
