#include "volume/clean/relabel_trial.h"

#include <algorithm>
#include <utility>

#include "base/union_find.h"
#include "geometry/topology/simple_points_26.h"
#include "geometry/topology/simple_points_kuhn.h"

namespace voxtet {
namespace {

constexpr std::uint32_t kNoFront = 0, kOutside = 0xffffffffU;
constexpr std::uint32_t kWholeCube = ((1U << kCube) - 1) & ~(1U << kCubeMiddle);
constexpr std::uint32_t kWholeRing = (1U << kNeighbours) - 1;

template <std::size_t kCount>
int count_bit_pieces(std::uint32_t within, const NeighbourRings<kCount>& rings) {
  int pieces = 0;
  for (std::uint32_t rest = within; rest != 0; ++pieces) rest &= ~grow_piece(rest & -rest, within, rings);
  return pieces;
}

}  // namespace

RelabelTrial::RelabelTrial(PaddedLabels& labels, Connectivity connectivity)
    : labels_(labels), connectivity_(connectivity), fronts_(labels.labels.size(), kOutside) {
  labels.for_inner([&](std::size_t voxel) { fronts_[voxel] = kNoFront; });
  // One layer of the margin belongs to the background, the other ends the search.
  const std::array<int, 3>& size = labels.size;
  for (int k = 1; k < size[2] - 1; ++k)
    for (int j = 1; j < size[1] - 1; ++j)
      for (int i = 1; i < size[0] - 1; ++i)
        fronts_[static_cast<std::size_t>(labels.step({i, j, k}))] = kNoFront;
  for (std::size_t n = 0; n < kCube; ++n) {
    const auto by = cube_step(n);
    const int axes = (by[0] != 0) + (by[1] != 0) + (by[2] != 0);
    cube_steps_.push_back(labels.step(by));
    if (axes == 1) face_steps_.push_back(labels.step(by));
    if (connectivity == Connectivity::kFaces && (axes == 1 || axes == 2))
      other_steps_.push_back(labels.step(by));
  }
  if (connectivity == Connectivity::kKuhn)
    for (std::size_t n = 0; n < kNeighbours; ++n) other_steps_.push_back(labels.step(step_to(n)));
}

std::array<int, 2> RelabelTrial::pieces_around(std::size_t voxel, Label label) const {
  const auto is_of = [&](std::ptrdiff_t step) {
    return labels_.labels[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(voxel) + step)] == label;
  };
  std::uint32_t like = 0;
  if (connectivity_ == Connectivity::kFaces) {
    for (std::size_t n = 0; n < kCube; ++n)
      if (n != kCubeMiddle && is_of(cube_steps_[n])) like |= 1U << n;
    return {pieces_at_middle(like, kFaceRings), pieces_at_middle(kWholeCube & ~like, kEdgeRings)};
  }
  for (std::size_t n = 0; n < kNeighbours; ++n)
    if (is_of(other_steps_[n])) like |= 1U << n;
  return {count_bit_pieces(like, kRings), count_bit_pieces(kWholeRing & ~like, kRings)};
}

int RelabelTrial::euler_change(const std::vector<std::size_t>& voxels, Label label, Label to) {
  int change = 0;
  for (const std::size_t voxel : voxels) {
    const auto [own, other] = pieces_around(voxel, label);
    change += to == label ? other - own : own - other;
    labels_.labels[voxel] = to;
  }
  return change;
}

std::size_t RelabelTrial::count_pieces(const std::vector<std::size_t>& voxels, Label label, bool others) {
  const std::vector<std::ptrdiff_t>& steps = steps_of(others ? kBackground : label);
  std::vector<std::vector<std::size_t>> queues;  // of each front, its voxels whose neighbours are to be seen
  std::vector<std::size_t> touched;
  const auto is_in = [&](std::size_t voxel) {
    return fronts_[voxel] != kOutside && (labels_.labels[voxel] == label) != others;
  };
  const auto after = [](std::size_t voxel, std::ptrdiff_t step) {
    return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(voxel) + step);
  };
  const auto begin_at = [&](std::size_t voxel) {
    if (!is_in(voxel) || fronts_[voxel] != kNoFront) return;
    queues.push_back({voxel});
    fronts_[voxel] = static_cast<std::uint32_t>(queues.size());
    touched.push_back(voxel);
  };
  for (const std::size_t voxel : voxels) {
    begin_at(voxel);
    for (const std::ptrdiff_t step : steps) begin_at(after(voxel, step));
  }
  UnionFind pieces(queues.size());
  std::vector<std::size_t> next(queues.size(), 0);
  // Each front makes one step at a time, so that a small piece ends the search beside a large one.
  for (std::size_t growing = 2; growing > 1;) {
    for (std::uint32_t f = 0; f < queues.size(); ++f) {
      if (next[f] == queues[f].size()) continue;
      const std::size_t voxel = queues[f][next[f]++];
      for (const std::ptrdiff_t step : steps) {
        const std::size_t other = after(voxel, step);
        if (!is_in(other)) continue;
        if (fronts_[other] != kNoFront) {
          pieces.join(f, fronts_[other] - 1);
          continue;
        }
        fronts_[other] = f + 1;
        touched.push_back(other);
        queues[f].push_back(other);
      }
    }
    std::vector<bool> grows(queues.size(), false);
    for (std::uint32_t f = 0; f < queues.size(); ++f)
      if (next[f] < queues[f].size()) grows[pieces.find(f)] = true;
    growing = static_cast<std::size_t>(std::count(grows.begin(), grows.end(), true));
  }
  for (const std::size_t voxel : touched) fronts_[voxel] = kNoFront;
  std::size_t count = 0;
  for (std::uint32_t f = 0; f < queues.size(); ++f) count += pieces.find(f) == f ? 1 : 0;
  return count;
}

void RelabelTrial::give(const std::vector<std::size_t>& voxels, Label label) {
  for (const std::size_t voxel : voxels) labels_.labels[voxel] = label;
}

bool RelabelTrial::is_simple(std::size_t voxel, Label to) const {
  const auto is_simple_for = [&](Label label) {
    return label == kBackground || pieces_around(voxel, label) == std::array{1, 1};
  };
  return is_simple_for(labels_.labels[voxel]) && is_simple_for(to);
}

HandlesTaken RelabelTrial::handles_taken(const std::vector<std::size_t>& voxels, Label to) {
  const Label from = labels_.labels[voxels.front()];
  const auto euler_of = [&](Label label) {
    if (label == kBackground) return 0;
    const int change = euler_change(voxels, label, to);
    give(voxels, from);
    return change;
  };
  const auto more_pieces = [&](Label label, bool others) {
    const std::size_t before = count_pieces(voxels, label, others);
    give(voxels, to);
    const std::size_t then = count_pieces(voxels, label, others);
    give(voxels, from);
    return static_cast<int>(then) - static_cast<int>(before);
  };
  // With pieces and cavities as before, the Euler characteristic grows by one for each handle that goes.
  const HandlesTaken taken{euler_of(from), euler_of(to)};
  if (taken.opened < 0 || taken.closed < 0 || !taken.any()) return {};
  for (const Label label : {from, to})
    if (label != kBackground && more_pieces(label, false) != 0) return {};
  if (from != kBackground && more_pieces(from, true) != 0) return {};
  if (to == kBackground) return taken;
  const int cavities = more_pieces(to, true);
  const bool parts_labels = cavities > 0 && more_pieces(kBackground, false) == 0;
  return cavities == 0 || (parts_labels && cavities <= taken.closed) ? taken : HandlesTaken{};
}

}  // namespace voxtet
