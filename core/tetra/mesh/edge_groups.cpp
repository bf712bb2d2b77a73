#include "tetra/mesh/edge_groups.h"

#include <algorithm>

namespace voxtet {

EdgeGroups::EdgeGroups(const SurfaceMesh& surface) {
  std::vector<std::uint32_t> next(surface.points.size() + 1, 0);
  const auto for_each_use = [&](auto&& visit) {
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t)
      for (std::uint8_t c = 0; c < 3; ++c) {
        const std::uint32_t a = surface.triangles[t][c], b = surface.triangles[t][(c + 1) % 3];
        visit(TriangleUse{std::min(a, b), std::max(a, b), t, c, a < b});
      }
  };
  for_each_use([&](const TriangleUse& use) { ++next[use.low + 1]; });
  for (std::size_t v = 1; v < next.size(); ++v) next[v] += next[v - 1];
  uses_.resize(3 * surface.triangles.size());
  for_each_use([&](const TriangleUse& use) { uses_[next[use.low]++] = use; });

  // Filling moved each vertex's start to its end; a bucket holds about three edges, so sorting it is cheap.
  std::uint32_t begin = 0;
  for (std::size_t v = 0; v + 1 < next.size(); ++v) {
    const std::uint32_t end = next[v];
    std::sort(uses_.begin() + begin, uses_.begin() + end, [](const TriangleUse& a, const TriangleUse& b) {
      return a.high != b.high ? a.high < b.high : a.triangle < b.triangle;
    });
    for (std::uint32_t u = begin; u < end; ++u)
      if (u == begin || uses_[u].high != uses_[u - 1].high) first_.push_back(u);
    begin = end;
  }
  first_.push_back(static_cast<std::uint32_t>(uses_.size()));
}

}  // namespace voxtet
