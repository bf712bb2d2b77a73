// How far each vertex of an extracted surface may move from its start.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "surface/smooth/voxel_regions.h"

namespace voxtet {

/// A box around the start of each vertex, in index space: `reach` in both directions of each index axis. A
/// voxel is slender if along at least two axes it has no neighbour of its region. A vertex on the lattice
/// edge between voxels p and q does not move towards p along the axes of that edge if p is slender, and the
/// same for q: so small components and wires one voxel thick keep the thickness they were extracted with.
/// Vertices inside a lattice cell are bounded by `reach` alone.
class MoveLimits {
 public:
  /// `start`: vertices of an extracted surface in index space, exact to a small fraction of a voxel.
  MoveLimits(const std::vector<Eigen::Vector3d>& start, const VoxelRegions& regions,
             const Eigen::Vector3d& reach);

  /// From now on the vertex does not move along this axis.
  void hold(std::size_t vertex, int axis) { kinds_[vertex] |= static_cast<std::uint8_t>(9U << axis); }

  /// Of vertices that nothing holds.
  const Eigen::Vector3d& reach() const { return boxes_[0].high; }
  /// Whether the vertex is on the lattice edge of a slender voxel.
  bool is_slender(std::size_t vertex) const { return kinds_[vertex] >= kKinds; }

  struct Box {
    Eigen::Vector3d low, high;  ///< displacement from the start
  };
  static constexpr std::size_t kKinds = 64;
  /// Vertices of one kind have the same box.
  std::uint8_t kind(std::size_t vertex) const { return kinds_[vertex] & (kKinds - 1); }
  const Box& box_of_kind(std::size_t kind) const { return boxes_[kind]; }
  const Box& box(std::size_t vertex) const { return boxes_[kind(vertex)]; }

 private:
  std::array<Box, kKinds> boxes_;
  std::vector<std::uint8_t> kinds_;  ///< bit d: not down along axis d; bit 3 + d: not up; bit 6: slender
};

}  // namespace voxtet
