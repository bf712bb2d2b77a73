#include "geometry/topology/label_components.h"

#include <map>

#include "base/union_find.h"

namespace voxtet {

std::vector<std::uint32_t> label_components(const std::array<int, 3>& size, const std::vector<Label>& labels,
                                            std::vector<std::uint32_t>& sizes, Connectivity connectivity) {
  const bool diagonals = connectivity == Connectivity::kKuhn;
  const std::size_t nx = static_cast<std::size_t>(size[0]), ny = static_cast<std::size_t>(size[1]);
  UnionFind sets(labels.size());
  std::size_t voxel = 0;
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i, ++voxel) {
        const Label label = labels[voxel];
        const bool follows = i > 0 && labels[voxel - 1] == label;
        const auto join = [&](std::size_t other) {
          sets.join(static_cast<std::uint32_t>(other), static_cast<std::uint32_t>(voxel));
        };
        // Two runs along rows are joined where they first meet.
        const auto join_row = [&](std::size_t other) {
          const bool before = i > 0 && labels[other - 1] == label;
          if (labels[other] == label && !(follows && before)) join(other);
          if (diagonals && before && !follows) join(other - 1);
        };
        if (follows) join(voxel - 1);
        if (j > 0) join_row(voxel - nx);
        if (k > 0) join_row(voxel - nx * ny);
        if (diagonals && j > 0 && k > 0) join_row(voxel - nx * ny - nx);
      }
  std::vector<std::uint32_t> ids(labels.size());
  sizes.clear();
  for (std::uint32_t v = 0; v < ids.size(); ++v) {
    const std::uint32_t first = sets.find(v);
    if (first == v) {
      ids[v] = static_cast<std::uint32_t>(sizes.size());
      sizes.push_back(0);
    } else {
      ids[v] = ids[first];
    }
    ++sizes[ids[v]];
  }
  return ids;
}

std::vector<std::uint32_t> count_components(const std::array<int, 3>& size,
                                            const std::vector<Label>& labels) {
  std::vector<std::uint32_t> sizes, counts(65536, 0);
  const std::vector<std::uint32_t> ids = label_components(size, labels, sizes);
  std::uint32_t next = 0;
  for (std::size_t v = 0; v < ids.size(); ++v) {
    if (ids[v] != next) continue;
    ++next;
    if (labels[v] != kBackground) ++counts[labels[v]];
  }
  return counts;
}

Label neighbour_by_area(const std::array<int, 3>& size, const std::vector<Label>& labels,
                        const std::vector<std::size_t>& voxels, const std::array<double, 3>& face_area) {
  const Label own = labels[voxels.front()];
  std::map<Label, std::array<std::size_t, 3>> faces;
  for (const std::size_t voxel : voxels)
    for_face_neighbours(size, voxel, [&](std::size_t other, std::size_t axis) {
      if (labels[other] != own) ++faces.try_emplace(labels[other]).first->second[axis];
    });
  Label best = own;
  double most = 0;
  for (const auto& [label, count] : faces) {
    double area = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) area += face_area[axis] * static_cast<double>(count[axis]);
    if (area > most) {
      best = label;
      most = area;
    }
  }
  return best;
}

}  // namespace voxtet
