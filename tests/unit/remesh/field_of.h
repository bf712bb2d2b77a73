#pragma once

#include "remesh/field/label_field.h"
#include "support/label_surface.h"

namespace voxtet::remesh {

/// The label field of a volume and its smoothed surface.
inline LabelField field_of(const LabelVolume& volume) {
  return {volume, test::label_surface(volume)};
}

}  // namespace voxtet::remesh
