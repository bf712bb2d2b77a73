// The adapted surface: the label boundaries triangulated to the sizing field.
#pragma once

#include "geometry/cut/cut_plane.h"
#include "remesh/remesh_params.h"
#include "types/label_volume.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"
#include "walls/wall_layers.h"

namespace voxtet {

/// The interfaces between all labels (background included) triangulated to the sizing field (median edge =
/// target): conforming between any number of labels, closed for each, free of self-intersections.
/// `label_surface` is the smoothed boundary complex of the labels of `volume`; it defines the shape. Planar
/// angles stay above about facet_angle_deg (delaunay, except for a few facets where labels meet) or 18
/// degrees (adapt, unless the label surface itself has sharper ones there). Where fidelity or a narrow place
/// requires it, triangles are smaller than their target: a warning tells the share. A note tells the method
/// used; a warning tells if and why the other method was the fallback.
///
/// With `layers` the sheets between them are interfaces too; merge_layers() removes them. Only method
/// delaunay makes them: a warning tells if the fallback was used, without sheets. Faces of `cuts` lie in
/// their planes, unless the surface would then meet itself.
///
/// Errors: kBadInput for malformed values; kUsage for layers with method adapt; kCancelled; kOutOfMemory;
/// kInternal where the triangulation fails.
Result<SurfaceMesh> remesh_surface(const LabelVolume& volume, const SurfaceMesh& label_surface,
                                   const SizingField& sizing, const RemeshParams& params, RunContext& ctx,
                                   const WallLayers& layers = {}, const CutPlanes& cuts = {});

}  // namespace voxtet
