#include "remesh/field/keep_contacts_open.h"

#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/topology/simple_points_kuhn.h"

namespace voxtet::remesh {
namespace {

constexpr double kContactLead = 0.3;  ///< of the two labels over the third

class Widener {
 public:
  Widener(const LabelVolume& grid, LabelDistances& distances) : grid_(grid), distances_(distances) {
    const std::size_t sx = static_cast<std::size_t>(grid.size[0]);
    const std::size_t sxy = sx * static_cast<std::size_t>(grid.size[1]);
    for (std::size_t n = 0; n < kUp; ++n) {
      const auto [x, y, z] = step_to(n);
      up_[n] =
          static_cast<std::size_t>(x) + static_cast<std::size_t>(y) * sx + static_cast<std::size_t>(z) * sxy;
    }
  }

  /// False when there was nothing to widen.
  bool run() {
    bool any = false;
    for (std::size_t v = 0; v < grid_.labels.size(); ++v) {
      if (distances_.offsets[v] == distances_.offsets[v + 1]) continue;
      for (std::size_t n = 0; n < kUp; ++n)
        if (grid_.labels[v + up_[n]] != grid_.labels[v]) any = widen(v, n) || any;
    }
    return any;
  }

 private:
  /// Of a voxel's list; null where it does not name the label.
  float* find(std::size_t voxel, Label label) {
    for (std::uint32_t e = distances_.offsets[voxel]; e < distances_.offsets[voxel + 1]; ++e)
      if (distances_.labels[e] == label) return &distances_.values[e];
    return nullptr;
  }

  bool widen(std::size_t v, std::size_t n) {
    constexpr double kRounding = 1e-6;
    const std::size_t w = v + up_[n];
    if (distances_.offsets[w] == distances_.offsets[w + 1]) return false;
    const Label a = grid_.labels[v], b = grid_.labels[w];
    const double a_at_v = *find(v, a), b_at_v = *find(v, b), a_at_w = *find(w, a), b_at_w = *find(w, b);
    const double at = (a_at_v - b_at_v) / (a_at_v - b_at_v + b_at_w - a_at_w);
    const double equal = a_at_v + at * (a_at_w - a_at_v);
    bool any = false;
    for (std::uint32_t e = distances_.offsets[v]; e < distances_.offsets[v + 1]; ++e) {
      const Label third = distances_.labels[e];
      float* const there = third == a || third == b ? nullptr : find(w, third);
      if (!there || !may_close(v, n, third)) continue;
      float& here = distances_.values[e];
      const double lead = here + at * (static_cast<double>(*there) - here) - equal + kContactLead;
      if (lead <= kRounding) continue;
      here -= static_cast<float>(lead);
      *there -= static_cast<float>(lead);
      any = true;
    }
    return any;
  }

  /// Whether the label stands around the edge on more than one side, or all around.
  bool may_close(std::size_t v, std::size_t n, Label label) const {
    std::uint32_t like = 0;
    for (std::size_t m = 0; m < kUp; ++m) {
      if (grid_.labels[v + up_[m]] == label) like |= 1U << m;
      if (grid_.labels[v - up_[m]] == label) like |= 1U << (m + kUp);
    }
    like &= kRings[n];
    return like == kRings[n] || !are_joined(like);
  }

  const LabelVolume& grid_;
  LabelDistances& distances_;
  std::array<std::size_t, kUp> up_{};
};

}  // namespace

void keep_contacts_open(const LabelVolume& grid, LabelDistances& distances) {
  // What is widened in one place may be too narrow in another one then; seldom, and less each time.
  constexpr int kRounds = 4;
  Widener widener(grid, distances);
  for (int round = 0; round < kRounds; ++round)
    if (!widener.run()) return;
}

}  // namespace voxtet::remesh
