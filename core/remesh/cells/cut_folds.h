// Walls that would lie upon a cut once its points are in its plane.
#pragma once

#include <vector>

#include "geometry/cut/cut_plane.h"
#include "remesh/cells/interface_edges.h"
#include "remesh/cells/labelled_cells.h"

namespace voxtet::remesh {

/// Those of the facets of interfaces that are no faces of a cut and have all corners on the rim of one.
std::vector<InterfaceFacet> find_cut_folds(const CutPlanes& cuts, const LabelledCells& cells,
                                           const std::vector<InterfaceFacet>& facets);

/// Cells at such facets of which all corners lie on that cut would be flat: they get the label of a cell
/// beside them, if that leaves fewer facets between labels, and the boundaries of labels as manifold.
void remove_cut_folds(const CutPlanes& cuts, LabelledCells& cells);

}  // namespace voxtet::remesh
