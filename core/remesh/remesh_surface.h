// The adapted surface: the label boundaries triangulated to the sizing field.
#pragma once

#include "types/label_volume.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"

namespace voxtet {

enum class RemeshMethod {
  kDelaunay,  ///< restricted Delaunay refinement: free of self-intersections by construction
};

struct RemeshParams {
  RemeshMethod method = RemeshMethod::kDelaunay;
  double facet_angle_deg = 30;  ///< lower bound on the planar angles; 0 to 30
  double max_distance_voxels =
      0.25;  ///< facet to label field, in units of the smallest spacing; at least 0.01
};

/// Restricted Delaunay triangulation of the interfaces between all labels (background included) of the
/// smoothed label field, facets sized by `sizing` (median edge = wish). Conforming between any number of
/// labels, closed for each, free of self-intersections. Planar angles stay above facet_angle_deg except at
/// the few facets that the relabelling of sharp wedges exposes (above 24 degrees in every case measured).
///
/// Where max_distance_voxels or a wall narrower than the wish demands it, facets are smaller than wished: a
/// warning tells the share. Components of the labels keep the voxels' topology before meshing (see
/// label_field.h); warnings tell how many vanished as specks of fewer than 8 voxels, where the surface's
/// components differ from the volume's, and where the boundary of a label touches itself.
///
/// Errors: kBadInput for malformed values; kMeshing, with a voxel centre of each, when labels are lost;
/// kCancelled; kOutOfMemory.
Result<SurfaceMesh> remesh_surface(const LabelVolume& volume, const SurfaceMesh& surface,
                                   const SizingField& sizing, const RemeshParams& params, RunContext& ctx);

}  // namespace voxtet
