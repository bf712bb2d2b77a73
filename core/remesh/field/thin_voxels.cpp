#include "remesh/field/thin_voxels.h"

namespace voxtet::remesh {
namespace {

bool in_block(const LabelVolume& grid, std::size_t voxel) {
  const std::size_t sx = static_cast<std::size_t>(grid.size[0]);
  const std::size_t sxy = sx * static_cast<std::size_t>(grid.size[1]);
  const auto corner = [&](std::size_t c) { return (c & 1) + (c >> 1 & 1) * sx + (c >> 2) * sxy; };
  for (std::size_t block = 0; block < 8; ++block) {
    const std::size_t low = voxel - corner(block);
    bool uniform = true;
    for (std::size_t c = 0; c < 8 && uniform; ++c)
      uniform = grid.labels[low + corner(c)] == grid.labels[voxel];
    if (uniform) return true;
  }
  return false;
}

}  // namespace

bool is_thin(const LabelVolume& grid, std::size_t voxel) {
  if (in_block(grid, voxel)) return false;
  const std::size_t sx = static_cast<std::size_t>(grid.size[0]);
  const std::size_t sxy = sx * static_cast<std::size_t>(grid.size[1]);
  std::size_t count = 0, neighbour = voxel;
  for (const std::size_t other : {voxel - 1, voxel + 1, voxel - sx, voxel + sx, voxel - sxy, voxel + sxy})
    if (grid.labels[other] == grid.labels[voxel]) {
      ++count;
      neighbour = other;
    }
  return count != 1 || !in_block(grid, neighbour);
}

}  // namespace voxtet::remesh
