// Which interface facets meet at which edge, in flat arrays.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "remesh/cells/labelled_cells.h"

namespace voxtet::remesh {

/// The facet opposite `corner` of `cell`; the cell's label is the higher of the two.
struct InterfaceFacet {
  std::uint32_t cell;
  std::uint32_t corner;
};

struct InterfaceEdges {
  std::vector<InterfaceFacet> facets;
  std::vector<std::array<std::uint32_t, 2>> ends;  ///< per edge, lower point first; ascending
  std::vector<std::uint32_t> start;                ///< per edge + 1: range in `facet_of`
  std::vector<std::uint32_t> facet_of;             ///< ids into `facets`
};

InterfaceEdges find_interface_edges(const LabelledCells& cells);

/// Where the boundary of a label touches itself.
struct Pinches {
  InterfaceEdges edges;
  std::vector<std::uint32_t> at_edges;  ///< edges at which some label has more than two boundary facets,
                                        ///< ascending
  /// Points at which the boundary facets of some label form more than one fan, ascending. A point at the end
  /// of a pinched edge is not counted for that alone.
  std::vector<std::uint32_t> at_points;

  /// The points at_points and the ends of pinched edges, each once, ascending.
  std::vector<std::uint32_t> points() const;
};

Pinches find_pinches(const LabelledCells& cells);

}  // namespace voxtet::remesh
