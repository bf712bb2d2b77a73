#include "tetra/mesh/vertices_apart.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/id_set.h"
#include "base/parallel.h"

namespace voxtet::tetra {
namespace {

struct Walk {
  IdSet seen;
  std::vector<std::uint32_t> star;
};

}  // namespace

SpreadOrder vertices_apart(const TetComplex& complex, std::span<const std::uint32_t> vertices, int threads) {
  constexpr std::size_t kAtOnce = 4096;
  std::vector<std::size_t> ends(complex.point_count(),
                                0);  // one more than the group of each vertex; 0: none yet
  std::vector<std::size_t> groups(vertices.size());
  std::vector<std::vector<std::uint32_t>> around(std::min(kAtOnce, vertices.size()));
  std::vector<Walk> walks(static_cast<std::size_t>(std::max(1, threads)));
  for (std::size_t first = 0; first < vertices.size(); first += kAtOnce) {
    const std::size_t some = std::min(kAtOnce, vertices.size() - first);
    run_tasks_with(walks, some, [&](std::size_t i, Walk& walk) {
      const std::uint32_t v = vertices[first + i];
      complex.find_star(v, walk.seen, walk.star);
      complex.find_neighbours(v, walk.star, walk.seen, around[i]);
    });
    for (std::size_t i = 0; i < some; ++i) {
      std::size_t group = 0;
      for (const std::uint32_t v : around[i]) group = std::max(group, ends[v]);
      groups[first + i] = group;
      ends[vertices[first + i]] = group + 1;
    }
  }
  return in_groups(groups);
}

}  // namespace voxtet::tetra
