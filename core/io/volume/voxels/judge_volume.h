// Whether a volume that could be read is likely to be what was meant.
#pragma once

#include "io/volume/voxels/reading.h"
#include "types/label_volume.h"

namespace voxtet {

/// How many values a volume has, 0 among them, where they are those of a grey image; 0 where they may be
/// labels. Labels form compact bodies: most of their voxels' neighbours have the same label, or none. The
/// values of an image do not: most of them have more neighbours of other values (speckle), or a quarter of
/// all neighbours differ, nearly all of them by little (a smooth image). More than 30 values are needed to
/// say so, more than 64 for a smooth image.
std::size_t count_values_of_image(const LabelVolume& volume);

/// Warns of what looks like a grey image, of lengths that look like a wrong unit, of one slice, and of
/// options that have no effect.
void warn_of_unlikely(const LabelVolume& volume, Reading& reading);

}  // namespace voxtet
