#include "sizing/wall_lengths.h"

#include <algorithm>
#include <cmath>

#include "geometry/distance_transform.h"
#include "geometry/parallel.h"

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
  std::array<double, 2> step{}, rise{};
  for (const std::size_t way : {std::size_t{0}, std::size_t{1}}) {
    const std::uint32_t to = graph.nodes[n].neighbour[2 * axis + way];
    step[way] = step_to(grid, graph, n, 2 * axis + way);
    const float end = to == kInnerEnd ? 0.F : (to == kOuterEnd ? 1.F : (to == kSideEnd ? u[n] : u[to]));
    rise[way] = (static_cast<double>(end) - u[n]) / step[way];
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

/// The direction, of the two along an axis, from which a length comes.
std::size_t upwind(const Slope& slope, std::size_t axis, bool from_inner) {
  return 2 * axis + ((slope[axis] < 0) == from_inner ? 1 : 0);
}

/// The transport of lengths from one of the surfaces. The nodes are numbered anew, in the order in which they
/// are reached, and those reached about together in the order of the grid, as memory has them.
class Transport {
 public:
  Transport(const WallGrid& grid, const WallGraph& graph, const std::vector<Slope>& slopes,
            std::vector<std::uint32_t> order, bool from_inner)
      : order_(std::move(order)),
        tolerance_(kLengthTolerance * static_cast<float>(grid.spacing_mm().minCoeff())) {
    std::vector<std::uint32_t> place(graph.nodes.size(), kNothing);
    for (std::uint32_t i = 0; i < order_.size(); ++i) place[order_[i]] = i;
    links_.resize(order_.size());
    const std::uint32_t end = from_inner ? kInnerEnd : kOuterEnd;
    for (std::size_t n = 0; n < place.size(); ++n) {
      if (place[n] == kNothing) continue;
      const auto number_of = [&](std::size_t direction) {
        const std::uint32_t to = graph.nodes[n].neighbour[direction];
        if (to < kInnerEnd) return place[to];
        if (to != end) return kNothing;
        beyond_.push_back(-grid.distance_mm[across(graph, graph.voxel[n], direction)]);
        return static_cast<std::uint32_t>(order_.size() + beyond_.size() - 1);
      };
      Link& link = links_[place[n]];
      for (std::size_t d = 0; d < 3; ++d) {
        const std::size_t up = upwind(slopes[n], d, from_inner);
        link.weight[d] = std::abs(slopes[n][d]);
        link.before[d] = number_of(up);
        link.after[d] = number_of(up ^ 1U);
      }
    }
  }

  /// A length for each node of the graph.
  std::vector<float> lengths(std::size_t nodes) const {
    std::vector<float> source(order_.size(), 1.F);
    std::vector<float> length = solve(source, beyond_);
    for (std::size_t i = 0; i < order_.size(); ++i) source[i] = 1 - central_slope(i, length);
    const std::vector<float> correction = solve(source, std::vector<float>(beyond_.size(), 0.F));
    std::vector<float> out(nodes, kFar);
    for (std::size_t i = 0; i < order_.size(); ++i)
      if (length[i] < kFar && correction[i] < kFar) out[order_[i]] = std::max(length[i] + correction[i], 0.F);
    return out;
  }

 private:
  static constexpr std::uint32_t kNothing = 0xffffffffU;

  /// What a node has along each axis: where lengths come from, and opposite.
  struct Link {
    std::array<std::uint32_t, 3> before, after;
    std::array<float, 3> weight;  ///< |T_d| / spacing_d
  };

  /// T . grad(value) = source, first order upwind; `beyond` are the values beyond the surface.
  std::vector<float> solve(const std::vector<float>& source, const std::vector<float>& beyond) const {
    std::vector<float> value(order_.size(), kFar);
    value.insert(value.end(), beyond.begin(), beyond.end());
    for (int pass = 0; pass < kMostPasses; ++pass) {
      std::size_t changed = 0;
      for (std::size_t i = 0; i < links_.size(); ++i) {
        const Link& link = links_[i];
        float sum = source[i], weights = 0;
        for (std::size_t d = 0; d < 3; ++d) {
          if (link.before[d] == kNothing || value[link.before[d]] == kFar) continue;
          sum += link.weight[d] * value[link.before[d]];
          weights += link.weight[d];
        }
        if (!(weights > 0)) continue;
        const float found = sum / weights;
        changed += !(std::abs(found - value[i]) <= tolerance_);
        value[i] = found;
      }
      if (changed <= links_.size() / kUnsettledPart) break;
    }
    return value;
  }

  /// T . grad(length) by central differences where there is something on both sides, else as `solve` has it.
  float central_slope(std::size_t i, const std::vector<float>& length) const {
    float slope = 0;
    const Link& link = links_[i];
    for (std::size_t d = 0; d < 3; ++d) {
      const float before = link.before[d] == kNothing ? kFar : length[link.before[d]];
      const float after = link.after[d] == kNothing ? kFar : length[link.after[d]];
      if (before == kFar) continue;
      slope += link.weight[d] * (after == kFar ? length[i] - before : (after - before) / 2);
    }
    return slope;
  }

  std::vector<std::uint32_t> order_;
  std::vector<Link> links_;
  std::vector<float> beyond_;  ///< minus the distance to the surface; numbered after the nodes
  float tolerance_;
};

/// The nodes that have a direction, each after those of lower potential from which its length comes (of
/// higher potential, if lengths come from the outer surface). Those free at the same time go as the grid has
/// them.
std::vector<std::uint32_t> upwind_order(const WallGraph& graph, const std::vector<float>& potential,
                                        const std::vector<Slope>& slopes, bool from_inner) {
  // Bit d: waits for the neighbour in direction d.
  std::vector<std::uint8_t> waits(slopes.size(), 0);
  std::vector<std::uint32_t> order;
  order.reserve(slopes.size());
  const auto look_at = [&](std::size_t n) {
    if (slopes[n] == Slope{}) return;
    for (std::size_t d = 0; d < 3; ++d) {
      const std::size_t up = upwind(slopes[n], d, from_inner);
      const std::uint32_t to = graph.nodes[n].neighbour[up];
      if (to >= kInnerEnd || slopes[n][d] == 0 || slopes[to] == Slope{}) continue;
      if (from_inner ? potential[to] < potential[n] : potential[to] > potential[n])
        waits[n] = static_cast<std::uint8_t>(waits[n] | 1U << up);
    }
    if (waits[n] == 0) order.push_back(static_cast<std::uint32_t>(n));
  };
  // The two colours of the graph, merged back into the order of the grid.
  std::size_t even = 0, odd = graph.even;
  while (even < graph.even || odd < slopes.size()) {
    const bool take_even =
        odd == slopes.size() || (even < graph.even && graph.voxel[even] < graph.voxel[odd]);
    look_at(take_even ? even++ : odd++);
  }
  constexpr std::size_t kAhead = 16;
  for (std::size_t head = 0; head < order.size(); ++head) {
    if (head + kAhead < order.size()) __builtin_prefetch(&graph.nodes[order[head + kAhead]]);
    for (std::size_t d = 0; d < 6; ++d) {
      const std::uint32_t to = graph.nodes[order[head]].neighbour[d];
      if (to >= kInnerEnd || !(waits[to] >> (d ^ 1U) & 1U)) continue;
      waits[to] = static_cast<std::uint8_t>(waits[to] & ~(1U << (d ^ 1U)));
      if (waits[to] == 0) order.push_back(to);
    }
  }
  return order;
}

}  // namespace

WallLengths wall_lengths(const WallGrid& grid, const WallGraph& graph, const std::vector<float>& potential,
                         int threads) {
  const std::vector<Slope> slopes = slopes_of(grid, graph, potential, threads);
  WallLengths out;
  parallel_for(threads, 2, [&](std::size_t first, std::size_t last) {
    for (std::size_t which = first; which < last; ++which) {
      const bool from_inner = which == 0;
      (from_inner ? out.to_inner : out.to_outer) =
          Transport(grid, graph, slopes, upwind_order(graph, potential, slopes, from_inner), from_inner)
              .lengths(slopes.size());
    }
  });
  return out;
}

}  // namespace voxtet::wall
