#include "phantom/keep_large_components.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "geometry/topology/label_components.h"

namespace voxtet {
namespace {

constexpr double kSpeckShare = 0.05;  // of the largest component of the same label

}  // namespace

void keep_large_components(LabelVolume& volume, const std::function<std::size_t(Label)>& most) {
  bool changed = true;
  while (changed) {
    changed = false;
    std::vector<std::uint32_t> sizes;
    const std::vector<std::uint32_t> ids = label_components(volume.size, volume.labels, sizes);
    std::vector<Label> label_of(sizes.size());
    for (std::size_t v = 0; v < ids.size(); ++v) label_of[ids[v]] = volume.labels[v];
    std::vector<std::uint32_t> by_size(sizes.size());
    std::iota(by_size.begin(), by_size.end(), 0U);
    std::stable_sort(by_size.begin(), by_size.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return sizes[a] > sizes[b]; });
    std::map<Label, std::vector<std::uint32_t>> kept_sizes;
    std::vector<bool> kept(sizes.size(), true);
    for (const std::uint32_t id : by_size) {
      if (label_of[id] == kBackground) continue;
      std::vector<std::uint32_t>& larger = kept_sizes[label_of[id]];
      kept[id] =
          larger.empty() || (larger.size() < most(label_of[id]) && sizes[id] >= kSpeckShare * larger.front());
      if (kept[id]) larger.push_back(sizes[id]);
    }
    std::map<std::pair<Label, std::uint32_t>, std::vector<std::size_t>> components;
    for (std::size_t v = 0; v < ids.size(); ++v)
      if (!kept[ids[v]]) components[{volume.labels[v], ids[v]}].push_back(v);
    for (const auto& [key, voxels] : components) {
      const Label replacement = neighbour_by_area(volume.size, volume.labels, voxels, {1, 1, 1});
      for (const std::size_t voxel : voxels) volume.labels[voxel] = replacement;
      changed = true;
    }
  }
}

}  // namespace voxtet
