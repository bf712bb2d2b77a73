// Scalar image -> VTK ImageData bytes (.vti).
#pragma once

#include <string>

#include "io/bytes/bytes.h"
#include "types/result.h"
#include "types/scalar_volume.h"

namespace voxtet {

/// XML with raw appended data: one point array of float32 under `name`, patient space RAS. Origin, Spacing
/// and Direction hold the affine (VTK 9 reads the direction). Errors: kUsage for axes that are not at right
/// angles, which ImageData cannot hold.
Result<Bytes> write_vti(const ScalarVolume& volume, const std::string& name);

}  // namespace voxtet
