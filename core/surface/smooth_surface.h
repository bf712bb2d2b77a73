// Staircase removal that keeps shape, volume and labels.
#pragma once

#include "types/label_volume.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/surface_mesh.h"

namespace voxtet {

struct SmoothParams {
  int iterations = 50;           ///< bi-Laplacian steps; 0 leaves the surface as it is
  double step = 0.4;             ///< mu of x - mu*L(L(x)); stable below 0.5
  double max_move_voxels = 0.5;  ///< clamp of each vertex around its start, per index axis
  bool keep_volume = true;       ///< shift along normals to restore each label's voxel volume
};

/// Clamped bi-Laplacian smoothing in index space: x <- clamp(x - mu*L(L(x))), umbrella weights. Vertices on
/// junctions of three or more labels use junction neighbours only; corners of junctions stay fixed.
/// Triangles and sides are those of the input. `volume` is the volume the surface was extracted from.
/// Errors: kUsage for parameters out of range.
Result<SurfaceMesh> smooth_surface(const SurfaceMesh& surface, const LabelVolume& volume,
                                   const SmoothParams& params, RunContext& ctx);

}  // namespace voxtet
