// Where the voxels of a NIfTI file are: the affines that its header holds, and which of them is used.
#pragma once

#include <Eigen/Core>

#include "io/volume/formats/nifti_header.h"
#include "io/volume/voxels/reading.h"

namespace voxtet {

/// Indices to mm, RAS: the sform when its code is > 0, else the qform when its code is > 0, else pixdim
/// centred on the image with x to the left (as nibabel does). A sform of zeros gives way to a good qform,
/// with a note; where both are good but place a corner of the image more than a tenth of a voxel apart, a
/// warning says by how much. Lengths in the unit of xyzt_units (mm where it names none), or in that of the
/// options. Errors: kBadInput naming the field.
Result<Eigen::Matrix4d> nifti_affine(const NiftiHeader& header, Reading& reading);

}  // namespace voxtet
