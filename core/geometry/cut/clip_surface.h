// A labelled surface cut by a plane.
#pragma once

#include <optional>

#include "geometry/cut/cut_plane.h"
#include "types/run_context.h"
#include "types/surface_mesh.h"

namespace voxtet {

/// What of the labels of cuts[cut] lies beyond its plane gets the label `beyond`, or becomes background where
/// it is farther off than `reach_mm`: triangles that the plane
/// passes through are divided there, and triangles in the plane part the labels from what is beyond, about as
/// large as the voxels of `volume`. Other labels keep their surface. Before, points are put into the plane,
/// as far as the surface does not come to intersect itself: those nearer to it than a quarter of their
/// shortest edge, and those beyond it where the volume has no voxel `beyond` near them. Points in planes of
/// other cuts stay in these. Nothing where surfaces meet in the plane, or when cancelled. Time: of a few
/// passes, and of a Delaunay triangulation in the plane.
std::optional<SurfaceMesh> clip_surface(SurfaceMesh surface, const LabelVolume& volume, const CutPlanes& cuts,
                                        std::size_t cut, const RunContext& ctx);

/// What a surface has of labels of which `volume` has no voxel, as less than a voxel before a plane, becomes
/// background.
void drop_lost_labels(SurfaceMesh& surface, const LabelVolume& volume);

}  // namespace voxtet
