// Exact search for triangles of a complex that meet elsewhere than in shared corners and edges.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "types/run_context.h"
#include "types/surface_mesh.h"

namespace voxtet {

using TrianglePair = std::array<std::uint32_t, 2>;  ///< lower index first

/// A tree of bounding boxes over the triangles of a complex. Its points may move; its triangles may not
/// change. Blocks of triangles along a Morton curve are the leaves, four nodes have one parent. Every search
/// measures the boxes afresh, so the order only has to be good near the points of construction. Neither
/// points nor triangles are copied: `surface` must outlive the tree.
class SelfIntersectionTree {
 public:
  explicit SelfIntersectionTree(const SurfaceMesh& surface, int threads = 1);

  /// Pairs of triangles whose intersection is more than their common corners or common edge
  /// (triangle_intersection.h), ascending, at the present points. With `concerned` (one entry per triangle)
  /// only pairs with at least one triangle whose entry is not 0. The search ends at `max_pairs`; which pairs
  /// are then returned is unspecified, but the same for any number of threads. Once `ctx` is cancelled, some
  /// are missing.
  std::vector<TrianglePair> find(std::span<const std::uint8_t> concerned = {}, std::size_t max_pairs = 100000,
                                 const RunContext& ctx = {});

 private:
  struct Box {
    std::array<double, 3> low, high;
  };
  struct Node {
    Box box;
    bool concerned = true;
  };
  class Search;

  void measure(std::span<const std::uint8_t> concerned);

  const SurfaceMesh& surface_;
  int threads_;
  std::vector<std::uint32_t> order_;       ///< triangle of each slot; a leaf is a block of slots
  std::vector<Box> boxes_;                 ///< by slot
  std::vector<std::vector<Node>> levels_;  ///< leaves first, the root's children last
};

/// The same in one call. Needs valid indices and triangles with an area. O(n log n) where few boxes overlap.
std::vector<TrianglePair> find_self_intersections(const SurfaceMesh& surface, std::size_t max_pairs = 100000,
                                                  int threads = 1);

}  // namespace voxtet
