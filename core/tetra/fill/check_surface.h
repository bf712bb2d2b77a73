// What a surface must fulfil before it can be filled with tetrahedra.
#pragma once

#include <Eigen/Core>

#include "tetra/mesh/edge_groups.h"
#include "types/result.h"
#include "types/surface_mesh.h"

namespace voxtet {

/// Checks that need no adjacency: finite points, all used; valid, distinct corners; triangles with an area;
/// the two sides of every triangle different and in order. kMeshing with the offending triangles.
Status check_triangles(const SurfaceMesh& surface);

/// Every label's boundary is closed: at each edge, the triangles bounding a label cancel. kMeshing with the
/// triangles at open edges and the edges' midpoints.
Status check_closed(const SurfaceMesh& surface, const EdgeGroups& edges);

/// No two triangles meet beyond common corners and edges. kMeshing with the triangles that do.
Status check_intersections(const SurfaceMesh& surface);

/// No two labels overlap: around each edge, the space between two successive triangles has one label. For a
/// closed surface without intersections this fails where a part of it is inside out. kMeshing with the
/// triangles at such edges and the edges' midpoints.
Status check_overlaps(const SurfaceMesh& surface, const EdgeGroups& edges);

struct SharpAngle {
  double angle_deg = 180;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
};

/// The sharpest angle between two triangles that share an edge: no tetrahedron there can have a larger
/// smallest dihedral angle.
SharpAngle find_sharpest_edge(const SurfaceMesh& surface, const EdgeGroups& edges);

/// The sharpest angle between two edges of a triangle.
SharpAngle find_sharpest_corner(const SurfaceMesh& surface);

/// Triangles where a mesher that failed most likely did so: those with points that nearly coincide with
/// others (within a millionth of the bounding box), or with an angle, in the plane or to a neighbour, below a
/// tenth of a degree. If there are none, those at the sharpest angles of either kind. Ascending.
ErrorPlace find_narrow_places(const SurfaceMesh& surface, const EdgeGroups& edges);

}  // namespace voxtet
