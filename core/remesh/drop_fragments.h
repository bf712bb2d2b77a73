// Removes the crumbs of labels that a coarse triangulation leaves beside an interface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "remesh/cell_complex.h"
#include "remesh/label_field.h"

namespace voxtet::remesh {

/// Facet-connected groups of cells of one label that hold no voxel centre of that label take the label that
/// most facets of their rim lead to. Groups of more than a few hundred cells and the largest of each label
/// stay. Returns how many cells changed.
std::size_t drop_fragments(CellComplex& cells, const LabelField& field);

/// The label to which most facets lead from a group of cells to cells of other labels.
Label label_around(const CellComplex& cells, const std::vector<std::uint32_t>& group);

}  // namespace voxtet::remesh
