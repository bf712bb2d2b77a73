// The two extraction methods behind extract_surface. Both assume a checked volume with some labelled voxel.
#pragma once

#include "types/label_volume.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/surface_mesh.h"

namespace voxtet {

/// Binary marching cubes of (label != background); every triangle gets sides {label, background}.
Result<SurfaceMesh> extract_marching_cubes(const LabelVolume& volume, Label label, RunContext& ctx);

/// Barycentric dual of all labels on the Kuhn subdivision.
Result<SurfaceMesh> extract_marching_tets(const LabelVolume& volume, RunContext& ctx);

}  // namespace voxtet
