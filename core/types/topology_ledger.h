// Topology of the labels: pieces, cavities, tunnels, contacts.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "types/label_volume.h"

namespace voxtet {

/// Betti numbers of one label's solid, from the closed surface around it.
struct LabelTopology {
  Label label = 0;
  std::uint32_t components = 0;      ///< shells that enclose a positive volume
  std::uint32_t cavities = 0;        ///< shells that enclose a negative volume
  std::uint32_t handles = 0;         ///< sum of the shells' genera: tunnels through the solid
  int euler = 0;                     ///< Euler number of the boundary: 2 (components + cavities - handles)
  std::uint32_t pinched_edges = 0;   ///< edges with more than two of the label's triangles
  std::uint32_t pinched_points = 0;  ///< points whose triangles of the label form more than one fan; fans
                                     ///< that share a pinched edge count as one
  std::uint32_t open_edges = 0;      ///< edges with an odd number of the label's triangles: above 0 the
                                     ///< surface is not closed and the other numbers mean nothing
  bool operator==(const LabelTopology&) const = default;
};

struct TopologyLedger {
  std::vector<LabelTopology> labels;           ///< background left out; ascending
  std::vector<std::array<Label, 2>> contacts;  ///< pairs of labels with a common triangle, lower first
                                               ///< (background is 0); ascending
  bool operator==(const TopologyLedger&) const = default;
};

}  // namespace voxtet
