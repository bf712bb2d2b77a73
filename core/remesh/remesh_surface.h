// The adapted surface: the label boundaries triangulated to the sizing field.
#pragma once

#include "geometry/wall_layers.h"
#include "remesh/adapt_complex.h"
#include "types/label_volume.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"

namespace voxtet {

enum class RemeshMethod {
  kDelaunay,  ///< restricted Delaunay refinement of the field of the labels' distances
  kRemesh,    ///< local operations on the label surface itself, each keeping topology and embedding
};

/// When a surface of method delaunay is given up for one of method remesh, which keeps all topology.
enum class KeepTopology {
  kLabels,   ///< when a label is lost or its boundary touches itself
  kAll,      ///< when pieces, cavities, handles or contacts of any label differ from the label surface's
  kNothing,  ///< never
};

struct RemeshParams {
  RemeshMethod method = RemeshMethod::kDelaunay;
  KeepTopology keep_topology = KeepTopology::kAll;
  double facet_angle_deg = 30;  ///< delaunay: lower bound on the planar angles; 0 to 30
  double max_distance_voxels =
      0.5;  ///< delaunay: facet to label field, in units of the smallest spacing; at least 0.01
  remesh::AdaptSchedule schedule = remesh::AdaptSchedule::kAdaptive;  ///< remesh: order of operations
  double shape_weight = 0.7;  ///< relocation, from sizes alone (0) to shapes alone (1)
  bool verify = false;        ///< look for intersections after every local operation (slow)
};

/// The interfaces between all labels (background included) triangulated to the sizing field (median edge =
/// wish): conforming between any number of labels, closed for each, free of self-intersections.
/// `label_surface` is the smoothed boundary complex of the labels of `volume`; it defines the shape. Planar
/// angles stay above about facet_angle_deg (delaunay, but for a few facets where labels meet) or 18 degrees
/// (remesh, unless the label surface itself has sharper ones there). Where fidelity or a narrow
/// place demands it, triangles are smaller than wished: a warning tells the share. A note tells the method
/// taken, a warning that and why the other one had to help out.
///
/// With `layers` the sheets between them are interfaces too (delaunay alone; a warning tells when the other
/// method had to be taken, without sheets): merge_layers() takes them out.
///
/// Errors: kBadInput for malformed values; kUsage for layers with method remesh; kCancelled; kOutOfMemory;
/// kInternal where the triangulation fails.
Result<SurfaceMesh> remesh_surface(const LabelVolume& volume, const SurfaceMesh& label_surface,
                                   const SizingField& sizing, const RemeshParams& params, RunContext& ctx,
                                   const WallLayers& layers = {});

}  // namespace voxtet
