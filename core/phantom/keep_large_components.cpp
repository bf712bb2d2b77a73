#include "phantom/keep_large_components.h"

#include <algorithm>
#include <map>

#include "geometry/topology/label_components.h"

namespace voxtet {

void keep_large_components(LabelVolume& volume, double share) {
  bool changed = true;
  while (changed) {
    changed = false;
    std::vector<std::uint32_t> sizes;
    const std::vector<std::uint32_t> ids = label_components(volume.size, volume.labels, sizes);
    std::vector<std::uint32_t> largest(65536, 0);
    for (std::size_t v = 0; v < ids.size(); ++v)
      largest[volume.labels[v]] = std::max(largest[volume.labels[v]], sizes[ids[v]]);
    std::map<std::pair<Label, std::uint32_t>, std::vector<std::size_t>> components;
    for (std::size_t v = 0; v < ids.size(); ++v) {
      const Label label = volume.labels[v];
      if (label != kBackground && sizes[ids[v]] < share * largest[label])
        components[{label, ids[v]}].push_back(v);
    }
    for (const auto& [key, voxels] : components) {
      const Label replacement = neighbour_by_area(volume.size, volume.labels, voxels, {1, 1, 1});
      for (const std::size_t voxel : voxels) volume.labels[voxel] = replacement;
      changed = true;
    }
  }
}

}  // namespace voxtet
