#include "remesh/topology_ledger.h"

namespace voxtet::remesh {

std::vector<std::uint32_t> lost_components(const CellComplex& cells, const Seeds& seeds,
                                           const std::vector<std::uint32_t>& seed_points) {
  constexpr std::uint32_t kNoSeed = 0xffffffffU;
  std::vector<std::uint32_t> seed_at(cells.points.size(), kNoSeed);
  for (std::uint32_t s = 0; s < seed_points.size(); ++s)
    if (seed_points[s] != CellComplex::kNone) seed_at[seed_points[s]] = s;
  std::vector<std::uint8_t> found(seeds.component_labels.size(), 0);
  for (std::size_t c = 0; c < cells.labels.size(); ++c)
    for (const std::uint32_t p : cells.vertices[c]) {
      if (seed_at[p] == kNoSeed) continue;
      for (const std::uint32_t component : seeds.components[seed_at[p]])
        if (seeds.component_labels[component] == cells.labels[c]) found[component] = 1;
    }
  std::vector<std::uint32_t> lost;
  for (std::uint32_t component = 0; component < found.size(); ++component)
    if (!found[component]) lost.push_back(component);
  return lost;
}

std::vector<std::uint32_t> count_components(const CellComplex& cells) {
  std::vector<std::uint32_t> counts(65536, 0), stack;
  std::vector<bool> seen(cells.labels.size(), false);
  for (std::uint32_t c = 0; c < seen.size(); ++c) {
    if (seen[c]) continue;
    seen[c] = true;
    ++counts[cells.labels[c]];
    stack.push_back(c);
    while (!stack.empty()) {
      const std::uint32_t cell = stack.back();
      stack.pop_back();
      for (const std::uint32_t n : cells.neighbours[cell]) {
        if (n == CellComplex::kNone || seen[n] || cells.labels[n] != cells.labels[cell]) continue;
        seen[n] = true;
        stack.push_back(n);
      }
    }
  }
  return counts;
}

}  // namespace voxtet::remesh
