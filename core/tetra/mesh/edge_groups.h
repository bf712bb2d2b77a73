// The triangles around each edge of a triangle complex, as flat arrays.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "types/surface_mesh.h"

namespace voxtet {

/// One triangle at an edge: the edge goes from its corner `corner` to the next one. `forward`: that is from
/// the edge's lower vertex to its higher one.
struct TriangleUse {
  std::uint32_t low = 0, high = 0;
  std::uint32_t triangle = 0;
  std::uint8_t corner = 0;
  bool forward = true;
};

/// Edge uses sorted by (low, high, triangle); `first[e]` to `first[e + 1]` are the uses of edge e.
class EdgeGroups {
 public:
  /// Needs valid indices and three distinct corners in every triangle.
  explicit EdgeGroups(const SurfaceMesh& surface);

  std::size_t size() const { return first_.size() - 1; }
  std::span<const TriangleUse> operator[](std::size_t edge) const {
    return {uses_.data() + first_[edge], uses_.data() + first_[edge + 1]};
  }

 private:
  std::vector<TriangleUse> uses_;
  std::vector<std::uint32_t> first_;
};

}  // namespace voxtet
