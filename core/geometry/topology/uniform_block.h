// Voxels in blocks of one label.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "types/label_volume.h"

namespace voxtet {

/// Whether a voxel belongs to a block of 2 x 2 x 2 voxels of its label. It must not be in the outermost layer
/// of the grid.
inline bool in_uniform_block(const std::array<int, 3>& size, const std::vector<Label>& labels,
                             std::size_t voxel) {
  const std::size_t sx = static_cast<std::size_t>(size[0]), sxy = sx * static_cast<std::size_t>(size[1]);
  const auto corner = [&](std::size_t c) { return (c & 1) + (c >> 1 & 1) * sx + (c >> 2) * sxy; };
  for (std::size_t block = 0; block < 8; ++block) {
    const std::size_t low = voxel - corner(block);
    bool uniform = true;
    for (std::size_t c = 0; c < 8 && uniform; ++c) uniform = labels[low + corner(c)] == labels[voxel];
    if (uniform) return true;
  }
  return false;
}

}  // namespace voxtet
