// Staircase removal that keeps shape, volume and labels.
#pragma once

#include "types/label_volume.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/surface_mesh.h"

namespace voxtet {

struct SmoothParams {
  int iterations = 50;           ///< bi-Laplacian steps; 0 returns the surface as it is
  double step = 0.4;             ///< mu of x - mu*L(L(x)), in (0, 0.5): stable below 0.5
  double max_move_voxels = 0.5;  ///< clamp of each vertex around its start, per index axis, in (0, 1]
  bool keep_volume = true;       ///< shift along normals to restore each label's voxel volume
};

/// Clamped bi-Laplacian smoothing in index space: x <- clamp(x - mu*L(L(x))), umbrella weights. Vertices on
/// junctions of three or more labels use junction neighbours only; corners of junctions and junction loops of
/// up to ten vertices stay fixed. Triangles that would collapse or turn over (specks, pillars one voxel
/// thick) go back towards their start. Then at most three shifts of the interfaces along their normals
/// restore the label volumes to first order, within the same clamp; the interface of labels a and b moves by
/// lambda_a - lambda_b, the distribution of least area-weighted square. Triangles and sides are those of the
/// input. `volume` is the volume the surface was extracted from (only its affine and voxel counts are used).
/// Linear time; deterministic. With the default clamp no voxel centre deeper than half a voxel inside its
/// label was seen to change side. Self-intersections are not searched for: they are rare where labels are
/// smooth, common in noise (geometry/self_intersections.h finds them). Errors: kUsage for parameters out of
/// range, kBadInput for an empty surface or a triangle without its points.
Result<SurfaceMesh> smooth_surface(const SurfaceMesh& surface, const LabelVolume& volume,
                                   const SmoothParams& params, RunContext& ctx);

}  // namespace voxtet
