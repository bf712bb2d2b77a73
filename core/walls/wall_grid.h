// A wall on a grid: its voxels, what lies on each of its sides, and the distances to its surface.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "types/grid.h"
#include "types/label_volume.h"
#include "types/surface_mesh.h"

namespace voxtet::wall {

/// What a voxel is. From kInner on, the voxel belongs to the inner space number `kind - kInner`.
enum Kind : std::uint8_t {
  kWall = 0,
  kSide = 1,   ///< beyond a face that is neither inner nor outer: the rim of the base, the image's border
  kOuter = 2,  ///< beyond the outer surface
  kInner = 3
};
inline constexpr std::size_t kMaxInner = 200;

/// Voxels of the wall and its surroundings, at least two voxels around the wall on every side. `distance_mm`
/// is only defined for voxels with a face neighbour on the other side of the wall's surface: the distance
/// from the voxel's centre to that surface, never 0.
struct WallGrid : Grid {
  std::vector<std::uint8_t> kind;
  std::vector<float> distance_mm;
};

/// The kinds of the voxels around the wall: `wall` labels are kWall, `inner` labels kInner and the following
/// numbers in their order, others kOuter; beyond the image is kSide. At least one voxel has a wall label.
WallGrid wall_grid(const LabelVolume& anatomy, const std::vector<Label>& wall,
                   const std::vector<Label>& inner);

/// The same grid with `factor` voxels for each along every axis.
WallGrid refined(const WallGrid& grid, int factor);

/// Measures `distance_mm` to the triangles, and moves voxels whose centre lies on the other side of them to
/// that side. The triangles are those of the wall's surface, with normals out of the wall, within about
/// `steps` voxels of where the kinds change. Where no triangle is near, the distance is 0.37 voxels, which is
/// right on average (measured on shells). About linear time; the same for any number of threads.
void measure_distances(const std::vector<Eigen::Vector3d>& points, const std::vector<Triangle>& triangles,
                       int steps, int threads, WallGrid& grid);

}  // namespace voxtet::wall
