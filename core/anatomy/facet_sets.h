// The named surfaces of a heart as sets of faces and of points, for files that others read.
#pragma once

#include <vector>

#include "types/heart_surfaces.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// The faces of each surface that there are any of, named as name_of(HeartSurface) says: "epicardium",
/// "lv_endocardium", "rv_endocardium", "rv_septum", "base".
std::vector<NamedSet> facet_sets(const HeartSurfaces& surfaces);

/// The rims of the openings: the points of edges between the base and an endocardium, "lv_rim" and, with a
/// right ventricle, "rv_rim".
std::vector<NamedSet> rim_sets(const TetMesh& mesh, const HeartSurfaces& surfaces);

}  // namespace voxtet
