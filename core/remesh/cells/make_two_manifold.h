// Small changes of cell labels that make the boundary of every label a 2-manifold.
#pragma once

#include <cstddef>

#include "remesh/cells/interface_edges.h"
#include "remesh/cells/labelled_cells.h"
#include "remesh/field/label_field.h"

namespace voxtet::remesh {

/// Around a point of a 2-manifold boundary the cells of a label are connected over facets, and so are all
/// others. Where this fails, the boundary of a label (or of background) touches itself at an edge or a point.
/// There the smallest separate group of cells gets the label of its neighbours, or a gap is filled, if that
/// leaves fewer such places and none of these cells lies deeper than half a voxel (smallest spacing) in its
/// label. No label loses its last cell. `pinches` are those of the cells. Returns how many cells changed.
std::size_t make_two_manifold(LabelledCells& cells, const LabelField& field, const Pinches& pinches);

/// Repairs labels of the volume whose boundary touches itself although that of none of their layers does.
/// Cells that change labels get the layer of their place; contacts that this creates are repaired in turn.
void mend_parents(LabelledCells& cells, const LabelField& field);

}  // namespace voxtet::remesh
