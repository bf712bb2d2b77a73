// Small changes of cell labels that remove needle-sharp wedges from the interfaces.
#pragma once

#include "remesh/cells/labelled_cells.h"

namespace voxtet::remesh {

/// Wedges sharper than this between two interface facets are worth a change.
inline constexpr double kSharpSectorDeg = 27;

/// Flat cells lie on the interfaces of a restricted Delaunay triangulation; on which side their circumcentre
/// falls is chance. An edge sector is the run of cells of one label between two interface facets. If it is
/// sharper than kSharpSectorDeg, it or one cell beside it gets the neighbouring label if that lowers the cost
/// of the edges and facets concerned. The facets stay a subset of the triangulation; no label loses its last
/// cell.
void remove_wedges(LabelledCells& cells);

}  // namespace voxtet::remesh
