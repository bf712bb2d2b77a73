#include "walls/wall_lengths.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "geometry/grid/distance_transform.h"

namespace voxtet::wall {
namespace {

constexpr int kMostPasses = 30;
constexpr std::size_t kUnsettledPart = 2000;  ///< one node of so many may still change
constexpr float kLengthTolerance = 1e-3F;     ///< of the smallest spacing
constexpr double kFlat = 5e-4;                ///< a potential that rises less over a voxel tells no direction

/// The direction of the potential at each node, as |T_d| / spacing_d with the sign of T_d.
using Slope = std::array<float, 3>;

double derivative(const WallGrid& grid, const WallGraph& graph, const std::vector<float>& u, std::size_t n,
                  std::size_t axis) {
  const std::uint32_t before = graph.nodes[n].neighbour[2 * axis],
                      after = graph.nodes[n].neighbour[2 * axis + 1];
  if (before < kInnerEnd && after < kInnerEnd)
    return (static_cast<double>(u[after]) - u[before]) / (2 * graph.step_mm[axis]);
  std::array<double, 2> step{}, rise{};
  for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
    const std::uint32_t to = graph.nodes[n].neighbour[2 * axis + side];
    step[side] = step_to(grid, graph, n, 2 * axis + side);
    const float end = to == kInnerEnd ? 0.F : (to == kOuterEnd ? 1.F : (to == kSideEnd ? u[n] : u[to]));
    rise[side] = (static_cast<double>(end) - u[n]) / step[side];
  }
  return (rise[1] * step[0] - rise[0] * step[1]) / (step[0] + step[1]);
}

std::vector<Slope> slopes_of(const WallGrid& grid, const WallGraph& graph, const std::vector<float>& u,
                             int threads) {
  const double flat = kFlat / grid.spacing_mm().minCoeff();
  std::vector<Slope> slopes(u.size(), Slope{});
  parallel_for(threads, u.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t n = first; n < last; ++n) {
      Eigen::Vector3d g;
      for (std::size_t d = 0; d < 3; ++d) g[static_cast<int>(d)] = derivative(grid, graph, u, n, d);
      const double length = g.norm();
      if (!(length > flat)) continue;
      for (int d = 0; d < 3; ++d)
        slopes[n][static_cast<std::size_t>(d)] =
            static_cast<float>(g[d] / length / graph.step_mm[static_cast<std::size_t>(d)]);
    }
  });
  return slopes;
}

/// The direction, of the two along an axis, in which the potential falls.
std::size_t downhill(const Slope& slope, std::size_t axis) {
  return 2 * axis + (slope[axis] < 0 ? 1 : 0);
}

/// The nodes that have a direction, each after those of lower potential from which its length from the inner
/// surface comes; backwards, nearly all come after those from which the length from the outer surface comes.
/// Those free at the same time go as the grid has them.
std::vector<std::uint32_t> uphill_order(const WallGraph& graph, const std::vector<float>& potential,
                                        const std::vector<Slope>& slopes) {
  // Bit d: waits for the neighbour in direction d.
  std::vector<std::uint8_t> waits(slopes.size(), 0);
  std::vector<std::uint32_t> order;
  order.reserve(slopes.size());
  const auto look_at = [&](std::size_t n) {
    if (slopes[n] == Slope{}) return;
    for (std::size_t d = 0; d < 3; ++d) {
      const std::size_t down = downhill(slopes[n], d);
      const std::uint32_t to = graph.nodes[n].neighbour[down];
      if (to >= kInnerEnd || slopes[n][d] == 0 || slopes[to] == Slope{}) continue;
      if (potential[to] < potential[n]) waits[n] = static_cast<std::uint8_t>(waits[n] | 1U << down);
    }
    if (waits[n] == 0) order.push_back(static_cast<std::uint32_t>(n));
  };
  // The two colours of the graph, merged back into the order of the grid.
  std::size_t even = 0, odd = graph.even;
  for_indices(0, slopes.size(), [&](std::size_t) {
    const bool take_even =
        odd == slopes.size() || (even < graph.even && graph.voxel[even] < graph.voxel[odd]);
    look_at(take_even ? even++ : odd++);
  });
  constexpr std::size_t kAhead = 16;
  // No more than all nodes come to stand in the order; those that wait for one another never do.
  for_indices(0, slopes.size(), [&](std::size_t head) {
    if (head >= order.size()) return;
    if (head + kAhead < order.size()) __builtin_prefetch(&graph.nodes[order[head + kAhead]]);
    for (std::size_t d = 0; d < 6; ++d) {
      const std::uint32_t to = graph.nodes[order[head]].neighbour[d];
      if (to >= kInnerEnd || !(waits[to] >> (d ^ 1U) & 1U)) continue;
      waits[to] = static_cast<std::uint8_t>(waits[to] & ~(1U << (d ^ 1U)));
      if (waits[to] == 0) order.push_back(to);
    }
  });
  return order;
}

/// The transport of lengths from both surfaces. The nodes are numbered anew, in the order in which lengths
/// from the inner surface reach them, and those reached about together in the order of the grid, as memory
/// has them.
class Transport {
 public:
  Transport(const WallGrid& grid, const WallGraph& graph, const std::vector<Slope>& slopes,
            std::vector<std::uint32_t> order, int threads)
      : order_(std::move(order)),
        tolerance_(kLengthTolerance * static_cast<float>(grid.spacing_mm().minCoeff())) {
    link_nodes(grid, graph, slopes, threads);
  }

  /// A length from one of the surfaces for each node of the graph.
  std::vector<float> lengths(std::size_t nodes, bool from_inner) const {
    std::vector<float> source(order_.size(), 1.F);
    std::vector<float> length = solve(source, true, from_inner);
    for_indices(0, order_.size(),
                [&](std::size_t i) { source[i] = 1 - central_slope(i, length, from_inner); });
    const std::vector<float> correction = solve(source, false, from_inner);
    std::vector<float> out(nodes, kFar);
    for (std::size_t i = 0; i < order_.size(); ++i)
      if (length[i] < kFar && correction[i] < kFar) out[order_[i]] = std::max(length[i] + correction[i], 0.F);
    return out;
  }

 private:
  static constexpr std::uint32_t kNothing = 0xffffffffU;

  /// What a node has along each axis: where the potential falls to, and opposite.
  struct Link {
    std::array<std::uint32_t, 3> below, above;
    std::array<float, 3> weight;  ///< |T_d| / spacing_d

    /// Where lengths from one of the surfaces come from.
    const std::array<std::uint32_t, 3>& toward(bool inner) const { return inner ? below : above; }
  };
  /// A voxel beyond one of the surfaces.
  struct Beyond {
    float length;  ///< minus the distance to the surface
    bool inner;
  };

  /// Numbers what lies beyond the surfaces behind the nodes, and finds what lies next to each node.
  void link_nodes(const WallGrid& grid, const WallGraph& graph, const std::vector<Slope>& slopes,
                  int threads) {
    std::vector<std::uint32_t> place(graph.nodes.size(), kNothing);
    for (std::uint32_t i = 0; i < order_.size(); ++i) place[order_[i]] = i;
    const auto is_beyond = [](std::uint32_t to) { return to == kInnerEnd || to == kOuterEnd; };
    // What lies beyond the nodes of each part comes after that of the parts before.
    constexpr std::size_t kParts = 16;
    std::array<std::size_t, kParts + 1> beyond{};
    const auto for_nodes = [&](auto&& visit) {
      parallel_for(threads, kParts, [&](std::size_t first, std::size_t last) {
        for (std::size_t part = first; part < last; ++part)
          for_indices(place.size() * part / kParts, place.size() * (part + 1) / kParts, [&](std::size_t n) {
            if (place[n] != kNothing) visit(part, n);
          });
      });
    };
    for_nodes([&](std::size_t part, std::size_t n) {
      const auto& to = graph.nodes[n].neighbour;
      beyond[part + 1] += static_cast<std::size_t>(std::count_if(to.begin(), to.end(), is_beyond));
    });
    std::partial_sum(beyond.begin(), beyond.end(), beyond.begin());
    links_.resize(order_.size());
    beyond_.resize(beyond.back());
    for_nodes([&](std::size_t part, std::size_t n) {
      const auto number_of = [&](std::size_t direction) {
        const std::uint32_t to = graph.nodes[n].neighbour[direction];
        if (to < kInnerEnd) return place[to];
        if (!is_beyond(to)) return kNothing;
        const std::size_t number = beyond[part]++;
        beyond_[number] = {-grid.distance_mm[across(graph, graph.voxel[n], direction)], to == kInnerEnd};
        return static_cast<std::uint32_t>(order_.size() + number);
      };
      Link& link = links_[place[n]];
      for (std::size_t d = 0; d < 3; ++d) {
        const std::size_t down = downhill(slopes[n], d);
        link.weight[d] = std::abs(slopes[n][d]);
        link.below[d] = number_of(down);
        link.above[d] = number_of(down ^ 1U);
      }
    });
  }

  /// T . grad(value) = source, first order upwind, from values beyond a surface: those of lengths, or 0.
  std::vector<float> solve(const std::vector<float>& source, bool of_lengths, bool from_inner) const {
    std::vector<float> value(order_.size(), kFar);
    value.reserve(order_.size() + beyond_.size());
    for (const Beyond& b : beyond_) value.push_back(b.inner != from_inner ? kFar : of_lengths ? b.length : 0);
    // The first pass takes every node, later ones those that a change has reached since; at first those that
    // came before what their value comes from.
    std::vector<std::uint8_t> due(links_.size(), 1);
    for (int pass = 0; pass < kMostPasses; ++pass) {
      std::size_t changed = 0;
      for_indices(0, links_.size(), [&](std::size_t k) {
        const std::size_t i = from_inner ? k : links_.size() - 1 - k;
        if (!due[i]) return;
        due[i] = 0;
        const Link& link = links_[i];
        float sum = source[i], weights = 0;
        for (std::size_t d = 0; d < 3; ++d) {
          const std::uint32_t before = link.toward(from_inner)[d];
          if (before == kNothing) continue;
          if (pass == 0 && before < links_.size() && (before > i) == from_inner) due[i] = 1;
          if (value[before] == kFar) continue;
          sum += link.weight[d] * value[before];
          weights += link.weight[d];
        }
        if (!(weights > 0)) return;
        const float found = sum / weights;
        const bool moved = !(std::abs(found - value[i]) <= tolerance_);
        value[i] = found;
        changed += moved;
        if (moved && pass > 0) mark_dependents(i, from_inner, due);
      });
      if (changed <= links_.size() / kUnsettledPart) break;
    }
    return value;
  }

  /// Marks the nodes whose value comes from that of node i.
  void mark_dependents(std::size_t i, bool from_inner, std::vector<std::uint8_t>& due) const {
    for (const auto* side : {&links_[i].below, &links_[i].above})
      for (const std::uint32_t to : *side) {
        if (to >= links_.size()) continue;
        const std::array<std::uint32_t, 3>& before = links_[to].toward(from_inner);
        if (std::find(before.begin(), before.end(), i) != before.end()) due[to] = 1;
      }
  }

  /// T . grad(length) by central differences where there is something on both sides, else as `solve` has it.
  float central_slope(std::size_t i, const std::vector<float>& length, bool from_inner) const {
    float slope = 0;
    const Link& link = links_[i];
    for (std::size_t d = 0; d < 3; ++d) {
      const float below = link.below[d] == kNothing ? kFar : length[link.below[d]];
      const float above = link.above[d] == kNothing ? kFar : length[link.above[d]];
      const float before = from_inner ? below : above, after = from_inner ? above : below;
      if (before == kFar) continue;
      slope += link.weight[d] * (after == kFar ? length[i] - before : (after - before) / 2);
    }
    return slope;
  }

  std::vector<std::uint32_t> order_;
  std::vector<Link> links_;
  std::vector<Beyond> beyond_;  ///< numbered after the nodes
  float tolerance_;
};

}  // namespace

WallLengths wall_lengths(const WallGrid& grid, const WallGraph& graph, const std::vector<float>& potential,
                         int threads) {
  const std::vector<Slope> slopes = slopes_of(grid, graph, potential, threads);
  const Transport transport(grid, graph, slopes, uphill_order(graph, potential, slopes), threads);
  WallLengths out;
  parallel_for(threads, 2, [&](std::size_t first, std::size_t last) {
    for (std::size_t which = first; which < last; ++which)
      (which == 0 ? out.to_inner : out.to_outer) = transport.lengths(slopes.size(), which == 0);
  });
  return out;
}

}  // namespace voxtet::wall
