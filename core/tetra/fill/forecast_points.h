// How large a mesh is to be expected.
#pragma once

#include "types/sizing_field.h"
#include "types/surface_mesh.h"

namespace voxtet {

/// Points of the tetrahedra that fill a closed surface with edges as `sizing` asks for: those of the surface,
/// and one for every 5.5 tets, of which there are the integral of dV / (0.096 h^3). The integral is taken
/// over the cones from the surface's middle to its triangles, with signs; within some 10 % for bodies without
/// folds, always between the values for the smallest and the largest size.
double forecast_points(const SurfaceMesh& surface, const SizingField& sizing);

}  // namespace voxtet
