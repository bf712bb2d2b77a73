// The expected number of points of a mesh.
#pragma once

#include "types/sizing_field.h"
#include "types/surface_mesh.h"

namespace voxtet {

/// Points of the tetrahedra that fill a closed surface with edges as `sizing` asks for: those of the surface,
/// and one for every 5.5 tets. The number of tets is the integral of dV / (0.096 h^3), taken with signs over
/// the cones from the surface's middle to its triangles. Accurate to some 10 % for bodies without folds,
/// always between the values for the smallest and the largest size.
double forecast_points(const SurfaceMesh& surface, const SizingField& sizing);

}  // namespace voxtet
