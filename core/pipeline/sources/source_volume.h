// Volumes that a recipe brings along: generated, or coded within it.
#pragma once

#include <string>

#include "recipe/recipe.h"
#include "types/label_volume.h"
#include "types/result.h"

namespace voxtet {

/// Whether a source is a file, or nothing yet, rather than what is in the recipe itself.
inline bool needs_file(const Source& source) {
  return !source.phantom && !source.inlined;
}

/// The volume of a source that needs no file. Errors: those of make_phantom; kBadInput for a text that is no
/// coded volume.
Result<LabelVolume> make_volume(const Source& source);

/// The same case with its volume within it, and what a file says of labels in its legend. Errors: kUsage for
/// a volume that a link cannot hold.
Result<Recipe> with_inline_volume(Recipe recipe, const LabelVolume& volume);

}  // namespace voxtet
