#include "phantom/remove_specks.h"

#include <algorithm>
#include <map>

namespace voxtet {
namespace {

using Component = std::vector<std::size_t>;  // offsets of its voxels

/// Calls visit(offset) for the face neighbours of a voxel inside the grid.
template <class Visit>
void for_face_neighbours(const LabelVolume& volume, std::size_t offset, Visit visit) {
  const std::size_t nx = static_cast<std::size_t>(volume.size[0]);
  const std::size_t ny = static_cast<std::size_t>(volume.size[1]);
  const std::size_t i = offset % nx, j = offset / nx % ny, slice = nx * ny;
  if (i > 0) visit(offset - 1);
  if (i + 1 < nx) visit(offset + 1);
  if (j > 0) visit(offset - nx);
  if (j + 1 < ny) visit(offset + nx);
  if (offset >= slice) visit(offset - slice);
  if (offset + slice < volume.labels.size()) visit(offset + slice);
}

Component flood(const LabelVolume& volume, std::size_t seed, std::vector<bool>& seen) {
  Component component{seed};
  seen[seed] = true;
  for (std::size_t next = 0; next < component.size(); ++next)
    for_face_neighbours(volume, component[next], [&](std::size_t neighbour) {
      if (seen[neighbour] || volume.labels[neighbour] != volume.labels[seed]) return;
      seen[neighbour] = true;
      component.push_back(neighbour);
    });
  return component;
}

Label commonest_neighbour(const LabelVolume& volume, const Component& component) {
  const Label own = volume.labels[component.front()];
  std::map<Label, std::size_t> votes;
  for (const std::size_t voxel : component)
    for_face_neighbours(volume, voxel, [&](std::size_t neighbour) {
      if (volume.labels[neighbour] != own) ++votes[volume.labels[neighbour]];
    });
  Label best = own;
  std::size_t most = 0;
  for (const auto& [label, count] : votes)
    if (count > most) {
      best = label;
      most = count;
    }
  return best;
}

}  // namespace

void remove_specks(LabelVolume& volume, double share) {
  bool changed = true;
  while (changed) {
    changed = false;
    std::vector<bool> seen(volume.labels.size(), false);
    std::map<Label, std::vector<Component>> components;
    for (std::size_t voxel = 0; voxel < volume.labels.size(); ++voxel)
      if (!seen[voxel] && volume.labels[voxel] != kBackground)
        components[volume.labels[voxel]].push_back(flood(volume, voxel, seen));
    for (const auto& [label, parts] : components) {
      std::size_t largest = 0;
      for (const Component& part : parts) largest = std::max(largest, part.size());
      for (const Component& part : parts) {
        if (static_cast<double>(part.size()) >= share * static_cast<double>(largest)) continue;
        const Label replacement = commonest_neighbour(volume, part);
        for (const std::size_t voxel : part) volume.labels[voxel] = replacement;
        changed = true;
      }
    }
  }
}

}  // namespace voxtet
