// Refuses rules that cannot be met, naming the field.
#pragma once

#include <optional>

#include "sizing/build_sizing_field.h"

namespace voxtet {

/// The first field of the parameters that is out of range or names a label that the volume does not hold.
std::optional<Error> find_sizing_error(const LabelVolume& volume, const SizingParams& params);

}  // namespace voxtet
