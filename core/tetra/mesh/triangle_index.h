// The triangles of a surface, found by their corners.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "types/surface_mesh.h"

namespace voxtet::tetra {

/// Triangles with the same lowest corner are stored together.
class TriangleIndex {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  explicit TriangleIndex(const SurfaceMesh& surface) : first_(surface.points.size() + 1, 0) {
    for (const Triangle& t : surface.triangles) ++first_[canonical(t)[0] + 1];
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    entries_.resize(surface.triangles.size());
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
      const Triangle c = canonical(surface.triangles[t]);
      entries_[next[c[0]]++] = {c[1], c[2], t};
    }
  }

  /// The triangle with these corners and whether it has the same orientation; kNone where there is none.
  std::pair<std::uint32_t, bool> find(const Triangle& corners) const {
    const Triangle c = canonical(corners);
    for (std::uint32_t e = first_[c[0]]; e < first_[c[0] + 1]; ++e) {
      if (entries_[e][0] == c[1] && entries_[e][1] == c[2]) return {entries_[e][2], true};
      if (entries_[e][0] == c[2] && entries_[e][1] == c[1]) return {entries_[e][2], false};
    }
    return {kNone, false};
  }

 private:
  /// Rotates so that the smallest index comes first: orientation is kept.
  static Triangle canonical(const Triangle& t) {
    if (t[0] < t[1] && t[0] < t[2]) return t;
    return t[1] < t[2] ? Triangle{t[1], t[2], t[0]} : Triangle{t[2], t[0], t[1]};
  }

  std::vector<std::uint32_t> first_;
  std::vector<std::array<std::uint32_t, 3>> entries_;
};

}  // namespace voxtet::tetra
