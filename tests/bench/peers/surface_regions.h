// The connected regions that a surface bounds, for meshers that want every one of them named with its
// boundary.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "types/surface_mesh.h"

namespace voxtet::peers {

struct SurfaceRegions {
  std::uint32_t count = 0;  ///< regions are 1 .. count; 0 is background
  std::vector<std::array<std::uint32_t, 2>>
      of_triangle;  ///< the regions behind and in front of each triangle
};

/// A label's triangles fall into shells that share no point; one that encloses something is a region, with
/// those turned the other way inside of it, its cavities.
SurfaceRegions find_regions(const SurfaceMesh& surface);

}  // namespace voxtet::peers
