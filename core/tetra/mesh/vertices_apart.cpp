#include "tetra/mesh/vertices_apart.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/id_set.h"
#include "base/parallel.h"
#include "geometry/search/spread_order.h"

namespace voxtet::tetra {

Buckets<std::uint32_t> vertices_apart(const TetComplex& complex, std::span<const std::uint32_t> vertices,
                                      int threads) {
  constexpr std::size_t kAtOnce = 4096;
  // By vertex: one more than its group; 0 while it has none.
  std::vector<std::uint32_t> ends(complex.point_count(), 0);
  std::vector<std::uint32_t> groups(vertices.size());
  std::vector<std::vector<std::uint32_t>> stars(std::min(kAtOnce, vertices.size()));
  std::vector<IdSet> seen(static_cast<std::size_t>(std::max(1, threads)));
  for (std::size_t first = 0; first < vertices.size(); first += kAtOnce) {
    const std::size_t some = std::min(kAtOnce, vertices.size() - first);
    run_tasks_with(seen, some,
                   [&](std::size_t i, IdSet& own) { complex.find_star(vertices[first + i], own, stars[i]); });
    for (std::size_t i = 0; i < some; ++i) {
      std::uint32_t group = 0;
      for (const std::uint32_t t : stars[i])
        for (const std::uint32_t v : complex.corners(t)) group = std::max(group, ends[v]);
      groups[first + i] = group;
      ends[vertices[first + i]] = group + 1;
    }
  }
  return in_groups(groups);
}

}  // namespace voxtet::tetra
