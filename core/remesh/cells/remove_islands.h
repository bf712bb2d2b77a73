// Removes small components of labels that a coarse triangulation leaves beside an interface.
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

/// Relabels islands: facet-connected groups of cells that are no separate piece of their label in the voxels.
/// These are groups without any voxel centre of the label, and groups with fewer than kIslandVoxels of them
/// that belong to a larger piece of the voxels. An island gets the label to which most of its outer facets
/// lead. Groups of more than a few hundred cells and the largest one of each label stay. Returns how many
/// cells changed.
/// `torn` receives, for islands with voxel centres, the places where they were torn off: their facets towards
/// a few cells beyond which the label goes on, for example at the mouths of a channel.
std::size_t remove_islands(LabelledCells& cells, const LabelField& field, const VoxelPieces& pieces,
                           std::vector<InterfaceFacet>* torn = nullptr);

inline constexpr std::size_t kIslandVoxels = 8;

/// The label to which most facets lead from a group of cells to cells of other labels.
Label label_around(const LabelledCells& cells, const std::vector<std::uint32_t>& group);

}  // namespace voxtet::remesh
