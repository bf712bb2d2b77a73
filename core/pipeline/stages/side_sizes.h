// The sizing field, made with the files that the recipe names for it.
#pragma once

#include "pipeline/results/stage_results.h"
#include "pipeline/sources/loaded_files.h"
#include "sizing/build_sizing_field.h"
#include "types/sizing_field.h"

namespace voxtet {

/// build_sizing_field with the masks and images that `sizing` names. Errors: its own, and kBadInput for a
/// file that was not loaded or is not the one that the recipe means.
Result<SizingField> build_sizing_field_of(const LoadedFiles& files, const SizingParams& sizing,
                                          const LabelVolume& volume, const SurfaceMesh& smooth,
                                          const Walls& walls, RunContext& ctx);

}  // namespace voxtet
