// The adapted surface by restricted Delaunay refinement of a label field.
#pragma once

#include "geometry/cut/cut_plane.h"
#include "remesh/field/label_field.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"
#include "types/topology_ledger.h"

namespace voxtet::remesh {

struct DelaunayParams {
  double facet_angle_deg = 30;
  double max_distance_voxels = 0.5;
  double missed_voxels = 0.5;  ///< places of the reference farther than this from the surface were missed
};

/// Seeds every interface, refines, then repairs what a triangulation of finite size gets wrong at junctions
/// (islands, needle wedges, pinches), and fits the points to the field. For a few rounds it adds points
/// where `reference`, the label surface that the field was made of, was missed. As long as the topology of
/// the surface is not `wanted`, that of the reference, these get closer and closer, regardless of the sizing
/// field, and contacts of labels that are still lost are made by cells that change labels. Facets are a
/// subset of one Delaunay triangulation until the fit, which is taken back where it would make them
/// intersect. The topology of what is beyond `cuts` is of no concern. Errors: kCancelled.
Result<SurfaceMesh> delaunay_surface(const LabelField& field, const SurfaceMesh& reference,
                                     const TopologyLedger& wanted, const SizingField& sizing,
                                     const DelaunayParams& params, RunContext& ctx,
                                     const CutPlanes& cuts = {});

}  // namespace voxtet::remesh
