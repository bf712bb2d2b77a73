// Tangential relaxation of an adapted surface.
#pragma once

#include "types/sizing_field.h"
#include "types/surface_mesh.h"

namespace voxtet::remesh {

/// Moves points inside the patches between two labels along their tangent planes, in a few sequential rounds,
/// towards the target sizes and equilateral triangles. No triangle becomes thinner than the thinnest around
/// its point or than 29 degrees, and none turns by more than 11 degrees in one move. Points where the surface
/// is sharply bent and points of junctions stay. Intersections are not checked.
void relax_surface(SurfaceMesh& surface, const SizingField& sizing);

}  // namespace voxtet::remesh
