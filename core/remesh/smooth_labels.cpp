#include "remesh/smooth_labels.h"
namespace voxtet::remesh {
std::vector<std::uint32_t> label_components(const std::array<int, 3>& size, const std::vector<Label>& labels,
                                            std::vector<std::uint32_t>& sizes) {
  constexpr std::uint32_t kNone = 0xffffffffU;
  const std::size_t count = labels.size();
  std::vector<std::uint32_t> parent(count);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  const std::size_t sx = static_cast<std::size_t>(size[0]), sxy = sx * static_cast<std::size_t>(size[1]);
  for (std::size_t v = 0; v < count; ++v) {
    std::uint32_t own = static_cast<std::uint32_t>(v);
    parent[v] = own;
    const std::size_t x = v % sx, y = v / sx % static_cast<std::size_t>(size[1]), z = v / sxy;
    const auto join = [&](std::size_t other) {
      if (labels[other] != labels[v]) return;
      const std::uint32_t r = root(static_cast<std::uint32_t>(other));
      if (r == own) return;
      parent[std::max(r, own)] = std::min(r, own);
      own = std::min(r, own);
    };
    if (x > 0) join(v - 1);
    if (y > 0) join(v - sx);
    if (z > 0) join(v - sxy);
  }
  std::vector<std::uint32_t> ids(count, kNone);
  sizes.clear();
  for (std::size_t v = 0; v < count; ++v) {
    const std::uint32_t r = root(static_cast<std::uint32_t>(v));
    if (r == v) {
      ids[v] = static_cast<std::uint32_t>(sizes.size());
      sizes.push_back(0);
    } else {
      ids[v] = ids[r];
    }
    ++sizes[ids[v]];
  }
  return ids;
}

}  // namespace voxtet::remesh
