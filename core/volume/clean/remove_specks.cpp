#include "volume/clean/remove_specks.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "geometry/topology/label_components.h"
#include "volume/clean/face_areas.h"

namespace voxtet {
namespace {

std::vector<bool> on_border(const Grid& grid, const std::vector<std::uint32_t>& ids, std::size_t components) {
  std::vector<bool> border(components, false);
  grid.visit([&](int i, int j, int k, std::size_t voxel) {
    if (grid.on_border(i, j, k)) border[ids[voxel]] = true;
  });
  return border;
}

/// Of each label the component with the most voxels, of equals the first.
std::vector<bool> largest_of_labels(const LabelVolume& volume, const std::vector<std::uint32_t>& ids,
                                    const std::vector<std::uint32_t>& sizes) {
  constexpr std::uint32_t kNone = 0xffffffffU;
  std::vector<std::uint32_t> largest(65536, kNone);
  for (std::size_t v = 0; v < ids.size(); ++v) {
    std::uint32_t& best = largest[volume.labels[v]];
    if (best == kNone || sizes[ids[v]] > sizes[best]) best = ids[v];
  }
  std::vector<bool> is_largest(sizes.size(), false);
  for (std::size_t label = kBackground + 1; label < largest.size(); ++label)
    if (largest[label] != kNone) is_largest[largest[label]] = true;
  return is_largest;
}

/// The voxels of each component to be removed, the smallest first.
std::vector<std::vector<std::size_t>> small_components(const LabelVolume& volume, const SpeckLimits& limits) {
  std::vector<std::uint32_t> sizes;
  const std::vector<std::uint32_t> ids = label_components(volume.size, volume.labels, sizes);
  const std::vector<bool> border = on_border(volume, ids, sizes.size());
  const std::vector<bool> largest = largest_of_labels(volume, ids, sizes);
  std::vector<std::vector<std::size_t>> voxels(sizes.size());
  for (std::size_t v = 0; v < ids.size(); ++v) {
    const bool hole = volume.labels[v] == kBackground;
    if (sizes[ids[v]] < (hole ? limits.hole_voxels : limits.speck_voxels) && !(hole && border[ids[v]]) &&
        !largest[ids[v]])
      voxels[ids[v]].push_back(v);
  }
  std::erase_if(voxels, [](const auto& component) { return component.empty(); });
  std::stable_sort(voxels.begin(), voxels.end(),
                   [](const auto& a, const auto& b) { return a.size() < b.size(); });
  return voxels;
}

/// Whether a component, its voxels ascending, has become part of a larger one.
bool has_grown(const LabelVolume& volume, const std::vector<std::size_t>& component) {
  const Label own = volume.labels[component.front()];
  bool grown = false;
  for (const std::size_t voxel : component)
    for_face_neighbours(volume.size, voxel, [&](std::size_t other, std::size_t) {
      grown = grown ||
              (volume.labels[other] == own && !std::binary_search(component.begin(), component.end(), other));
    });
  return grown;
}

}  // namespace

std::map<Label, RemovedPieces> remove_specks(LabelVolume& volume, const SpeckLimits& limits) {
  const std::array<double, 3> areas = face_areas(volume);
  std::map<Label, RemovedPieces> removed;
  if (limits.speck_voxels == 0 && limits.hole_voxels == 0) return removed;
  // A component that another one has become part of is looked at again, as what it is then.
  for (bool again = true; std::exchange(again, false);) {
    for (const std::vector<std::size_t>& voxels : small_components(volume, limits)) {
      const Label own = volume.labels[voxels.front()];
      if (has_grown(volume, voxels)) {
        again = true;
        continue;
      }
      const Label other = neighbour_by_area(volume.size, volume.labels, voxels, areas);
      if (other == own) continue;
      for (const std::size_t voxel : voxels) volume.labels[voxel] = other;
      again = true;
      RemovedPieces& sum = removed.try_emplace(own).first->second;
      ++sum.pieces;
      sum.voxels += voxels.size();
      sum.largest = std::max(sum.largest, voxels.size());
    }
  }
  return removed;
}

}  // namespace voxtet
