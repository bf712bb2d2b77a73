// Removes the small components of labels that a coarse triangulation leaves beside an interface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/topology/label_components.h"
#include "remesh/cells/interface_edges.h"
#include "remesh/cells/labelled_cells.h"
#include "remesh/field/label_field.h"

namespace voxtet::remesh {

/// Connected components of the field's labels at voxel centres.
struct VoxelPieces {
  std::vector<std::uint32_t> ids, sizes;
};
VoxelPieces find_pieces(const LabelField& field);

/// Facet-connected groups of cells of one label that are no piece of the label on their own take the label
/// that most facets of their rim lead to: those that hold no voxel centre of the label, and those that hold
/// fewer than kIslandVoxels and belong to a larger piece of the voxels. Groups of more than a few hundred
/// cells and the largest of each label stay. Returns how many cells changed.
/// `torn` receives where those that hold voxel centres were torn off: their facets towards a few cells beyond
/// which the label goes on, for example at the mouths of a channel.
std::size_t remove_islands(LabelledCells& cells, const LabelField& field, const VoxelPieces& pieces,
                           std::vector<InterfaceFacet>* torn = nullptr);

inline constexpr std::size_t kIslandVoxels = 8;

/// The label to which most facets lead from a group of cells to cells of other labels.
Label label_around(const LabelledCells& cells, const std::vector<std::uint32_t>& group);

}  // namespace voxtet::remesh
