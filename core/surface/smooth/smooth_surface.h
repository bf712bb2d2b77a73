// Staircase removal that keeps shape, volume and labels.
#pragma once

#include "geometry/cut/cut_plane.h"
#include "types/label_volume.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/surface_mesh.h"

namespace voxtet {

struct SmoothParams {
  int iterations = 50;           ///< bi-Laplacian steps; 0 returns the surface as it is
  double step = 0.4;             ///< mu of x - mu*L(L(x)), in (0, 0.5): stable below 0.5
  double max_move_voxels = 0.5;  ///< clamp of each vertex around its start, per index axis, in (0, 1]
  /// Across slices that were interpolated, so much of a slice counts as a voxel there, if it is more than
  /// one.
  double slice_share = 0;
  bool keep_volume = true;  ///< shift along normals to restore each region's voxel volume
};

/// Clamped bi-Laplacian smoothing in index space, with momentum: x <- clamp(y - mu*L(L(y))), y a little ahead
/// of x, umbrella weights (bilaplacian.h). After the first third of the steps no vertex goes farther along
/// the normal than to where its tangent plane passes a voxel's centre (crossing_limits.h). Vertices on
/// junctions of three or more labels use junction neighbours only. Corners of junctions and junction loops of
/// up to ten vertices stay fixed. Small components and straight wires one voxel thick grow no thinner
/// (move_limits.h), and take the first third of the steps alone. Surfaces of several labels, whose edges are
/// half as long, take a third more, except at regions that are thinner than about four voxels, which take a
/// third; then they lose most of their vertices on diagonals of the lattice (join_diagonals.h). At last the
/// interfaces shift along their normals, within the same clamp, until every connected region of a label has
/// the volume of its voxels. The interface of regions a and b moves by lambda_a - lambda_b, the distribution
/// of least area-weighted square (volume_correction.h).
///
/// Guarantees, whatever the labels:
/// - No two triangles intersect beyond common corners and edges, if none did before
///   (geometry/repair/undo_intersections.h).
/// - Every voxel centre stays on its side of every label, except voxels at the surface of something thicker
///   than one voxel: those deeper than half a voxel, and those of sheets, wires, gaps and small components
///   one voxel thick, are kept (shape_guard.h).
/// - No vertex moves further than `max_move_voxels` along an index axis. Across slices that were
///   interpolated, of which each became `planes` voxels, `slice_share` of a slice counts as one voxel.
/// - Triangles and sides of one label are those of the input.
/// Volumes are met to about 1e-4 of a region unless the first three guarantees prevent it.
///
/// Vertices of cuts stay in their planes; `cuts` are in the grid of the volume.
///
/// `volume` is the volume the surface was extracted from. About linear time; identical for any ctx.threads.
/// Errors: kUsage for parameters out of range, kBadInput for an empty surface, a triangle whose points are
/// missing, or one whose two labels do not meet there in the volume.
Result<SurfaceMesh> smooth_surface(const SurfaceMesh& surface, const LabelVolume& volume,
                                   const SmoothParams& params, RunContext& ctx, const CutPlanes& cuts = {},
                                   const std::array<int, 3>& planes = {1, 1, 1});

}  // namespace voxtet
