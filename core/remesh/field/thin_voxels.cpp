#include "remesh/field/thin_voxels.h"

#include "geometry/topology/uniform_block.h"

namespace voxtet::remesh {

bool is_thin(const LabelVolume& grid, std::size_t voxel) {
  const auto in_block = [&](std::size_t v) { return in_uniform_block(grid.size, grid.labels, v); };
  if (in_block(voxel)) return false;
  const std::size_t sx = static_cast<std::size_t>(grid.size[0]);
  const std::size_t sxy = sx * static_cast<std::size_t>(grid.size[1]);
  std::size_t count = 0, neighbour = voxel;
  for (const std::size_t other : {voxel - 1, voxel + 1, voxel - sx, voxel + sx, voxel - sxy, voxel + sxy})
    if (grid.labels[other] == grid.labels[voxel]) {
      ++count;
      neighbour = other;
    }
  return count != 1 || !in_block(neighbour);
}

}  // namespace voxtet::remesh
