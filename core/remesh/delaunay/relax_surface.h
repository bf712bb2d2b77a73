// Points of an adapted surface spread along it.
#pragma once

#include "types/sizing_field.h"
#include "types/surface_mesh.h"

namespace voxtet::remesh {

/// Moves points inside the patches between two labels along their tangent planes, a few rounds one after the
/// other, towards the target sizes and equilateral triangles. No triangle becomes thinner than the thinnest
/// around its point or than 29 degrees, none turns by more than 11 degrees at once; points where the surface
/// is sharply bent stay, as do those of junctions. Intersections are not looked for.
void relax_surface(SurfaceMesh& surface, const SizingField& sizing);

}  // namespace voxtet::remesh
