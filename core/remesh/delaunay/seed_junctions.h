// First points along the curves where three and more labels meet, so that the refined surface follows them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/topology/adjacency.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"

namespace voxtet::remesh {

/// Edges of three and more triangles, sorted.
std::vector<Edge> junction_edges(const SurfaceMesh& surface);

/// Points (mm) on the junction curves of a label surface (edges of three and more triangles): the ends of all
/// curves first, then points that divide each curve into parts of about one target edge length. Fixed order.
std::vector<Eigen::Vector3d> seed_junctions(const SurfaceMesh& surface, const SizingField& sizing);

}  // namespace voxtet::remesh
