#include "volume/remove_specks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "geometry/topology/label_components.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

/// Area of a voxel's face across each index axis, mm^2.
std::array<double, 3> face_areas(const LabelVolume& volume) {
  const Eigen::Matrix3d axes = volume.linear();
  return {axes.col(1).cross(axes.col(2)).norm(), axes.col(2).cross(axes.col(0)).norm(),
          axes.col(0).cross(axes.col(1)).norm()};
}

std::vector<bool> on_border(const Grid& grid, const std::vector<std::uint32_t>& ids, std::size_t components) {
  std::vector<bool> border(components, false);
  grid.visit([&](int i, int j, int k, std::size_t voxel) {
    if (grid.on_border(i, j, k)) border[ids[voxel]] = true;
  });
  return border;
}

/// The voxels of each component to be removed, the smallest first.
std::vector<std::vector<std::size_t>> small_components(const LabelVolume& volume, const SpeckLimits& limits) {
  std::vector<std::uint32_t> sizes;
  const std::vector<std::uint32_t> ids = label_components(volume.size, volume.labels, sizes);
  const std::vector<bool> border = on_border(volume, ids, sizes.size());
  std::vector<std::vector<std::size_t>> voxels(sizes.size());
  for (std::size_t v = 0; v < ids.size(); ++v) {
    const bool hole = volume.labels[v] == kBackground;
    if (sizes[ids[v]] < (hole ? limits.hole_voxels : limits.speck_voxels) && !(hole && border[ids[v]]))
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

struct Removed {
  std::size_t components = 0, voxels = 0, largest = 0;
};

std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace

LabelVolume remove_specks(const LabelVolume& volume, const SpeckLimits& limits, const RunContext& ctx) {
  LabelVolume out = volume;
  const std::array<double, 3> areas = face_areas(volume);
  std::map<Label, Removed> removed;
  // A component that another one has become part of is looked at again, as what it is then.
  for (bool again = true; std::exchange(again, false);) {
    for (const std::vector<std::size_t>& voxels : small_components(out, limits)) {
      const Label own = out.labels[voxels.front()];
      if (has_grown(out, voxels)) {
        again = true;
        continue;
      }
      const Label other = neighbour_by_area(out.size, out.labels, voxels, areas);
      if (other == own) continue;
      for (const std::size_t voxel : voxels) out.labels[voxel] = other;
      again = true;
      Removed& sum = removed.try_emplace(own).first->second;
      ++sum.components;
      sum.voxels += voxels.size();
      sum.largest = std::max(sum.largest, voxels.size());
    }
  }
  std::vector<bool> left(65536, false);
  for (const Label label : out.labels) left[label] = true;
  for (const auto& [label, sum] : removed) {
    const bool hole = label == kBackground;
    ctx.note(kVolumeStage, "removed " + counted(sum.components, hole ? "hole" : "speck") +
                               (hole ? "" : " of label " + std::to_string(label)) + ": " +
                               counted(sum.voxels, "voxel") + ", the largest of " +
                               std::to_string(sum.largest));
    if (!hole && !left[label])
      ctx.warn(kVolumeStage, "label " + std::to_string(label) +
                                 " was removed altogether: no component of it has " +
                                 std::to_string(limits.speck_voxels) + " voxels");
  }
  return out;
}

}  // namespace voxtet
