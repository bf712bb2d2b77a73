// Small changes of cell labels that make the boundary of every label a 2-manifold.
#pragma once

#include <cstddef>

#include "remesh/cells/interface_edges.h"
#include "remesh/cells/labelled_cells.h"
#include "remesh/field/label_field.h"

namespace voxtet::remesh {

/// Around a point of a 2-manifold boundary the cells of a label are connected over facets, and so are all
/// others. Where that fails (the boundary of a label, or of background, touches itself at an edge or a
/// point), the smallest stray group of cells there takes the label next door, or a gap is filled, if that
/// leaves fewer such places and no cell concerned lies deeper than half a voxel (smallest spacing) in its
/// label. No label loses its last cell. `pinches` are those of the cells. Returns how many cells changed.
std::size_t make_two_manifold(LabelledCells& cells, const LabelField& field, const Pinches& pinches);

/// Parts labels of the volume that touch themselves though none of their layers does: cells that change
/// labels come into the layers of their places, and what that makes touch itself is mended in turn.
void mend_parents(LabelledCells& cells, const LabelField& field);

}  // namespace voxtet::remesh
