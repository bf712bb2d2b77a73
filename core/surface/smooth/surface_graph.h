// Which vertices may move when a labelled complex is smoothed, and which neighbours they use.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "types/surface_mesh.h"

namespace voxtet {

enum class VertexKind : std::uint8_t {
  kSurface,   ///< between two labels
  kJunction,  ///< on a curve where three labels meet
  kFixed,     ///< end or crossing of such curves, pinch, or part of a curve loop too short to smooth
};

/// Neighbours in compressed rows, ascending within a row: all mesh neighbours of a surface vertex, or the two
/// neighbours along the curve of a junction vertex. The row of a fixed vertex must not be used.
struct SurfaceGraph {
  std::vector<VertexKind> kinds;
  std::vector<std::uint32_t> first;  ///< size kinds.size() + 1
  std::vector<std::uint32_t> neighbours;

  std::span<const std::uint32_t> of(std::size_t vertex) const {
    return {neighbours.data() + first[vertex], first[vertex + 1] - first[vertex]};
  }
};

/// Closed junction curves without a corner would shrink to a point under smoothing. With up to this many
/// vertices they are fixed instead.
inline constexpr std::size_t kLongestFixedLoop = 10;

/// Linear time. `surface` must have valid indices.
SurfaceGraph build_surface_graph(const SurfaceMesh& surface);

}  // namespace voxtet
