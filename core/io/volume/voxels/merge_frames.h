// Labels of files that have one or several values for each voxel.
#pragma once

#include <functional>
#include <vector>

#include "io/volume/voxels/read_values.h"

namespace voxtet {

/// One label for each voxel. Of several frames (or layers) ReadOptions::frame picks one. Where it does not,
/// they must be one-hot or probability maps: values from 0 to 1 (or whole ones to 100 or 255) that sum to
/// that at most, in more than one frame. Then a voxel takes the frame with its largest value. Frame 0 is the
/// background where every voxel has the whole sum; else frame n gives the label n + 1, and what is missing is
/// the background's share. `feed` gives all values of the file to a sink. Errors: kBadInput; a file of other
/// frames names the option.
Result<std::vector<Label>> read_labels(const VoxelLayout& layout, Reading& reading,
                                       const std::function<Status(ValueSink&)>& feed);

}  // namespace voxtet
