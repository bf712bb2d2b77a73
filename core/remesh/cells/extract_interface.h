// From labelled cells to the triangles between different labels.
#pragma once

#include "remesh/cells/labelled_cells.h"
#include "types/surface_mesh.h"

namespace voxtet::remesh {

/// Triangles between cells of different labels, with SurfaceMesh's conventions, in the order of Morton's
/// curve; points keep the complex's order.
SurfaceMesh extract_interface(const LabelledCells& cells);

}  // namespace voxtet::remesh
