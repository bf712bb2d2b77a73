#include "walls/wall_potential.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace voxtet::wall {
namespace {

constexpr float kOmega = 1.85F;
constexpr int kMostSweeps = 500;
constexpr std::size_t kFewNodes = 5000;  ///< for which a start is not worth the trouble
constexpr float kPotentialTolerance = 1e-3F;
constexpr std::uint32_t kLongestRun = 256;  ///< so that parts of equally many runs take about equally long
constexpr double kLeastStep = 0.02;         ///< of a voxel

/// A node with the surface or a side beside it: what its neighbours weigh, and what the surfaces add. Where
/// it has no neighbour, it is its own with no weight.
struct EdgeNode {
  std::uint32_t node;
  std::array<std::uint32_t, 6> neighbour;
  std::array<float, 6> weight;
  float constant;
};

EdgeNode edge_node(const WallGrid& grid, const WallGraph& graph, std::size_t node) {
  std::array<double, 6> weight{};
  double sum = 0, constant = 0;
  for (std::size_t d = 0; d < 6; d += 2) {
    const double back = step_to(grid, graph, node, d), on = step_to(grid, graph, node, d + 1);
    weight[d] = 2 / (back * (back + on));
    weight[d + 1] = 2 / (on * (back + on));
    for (const std::size_t e : {d, d + 1}) {
      const std::uint32_t to = graph.nodes[node].neighbour[e];
      if (to == kSideEnd) continue;
      sum += weight[e];
      if (to == kOuterEnd) constant += weight[e];
    }
  }
  EdgeNode out{static_cast<std::uint32_t>(node), {}, {}, 0};
  out.neighbour.fill(out.node);
  if (!(sum > 0)) return out;
  for (std::size_t e = 0; e < 6; ++e) {
    const std::uint32_t to = graph.nodes[node].neighbour[e];
    if (to >= kInnerEnd) continue;
    out.neighbour[e] = to;
    out.weight[e] = static_cast<float>(weight[e] / sum);
  }
  out.constant = static_cast<float>(constant / sum);
  return out;
}

/// Nodes with all six neighbours, numbered one after the other, and so are their neighbours in each
/// direction.
struct Run {
  std::uint32_t node, count;
  std::array<std::uint32_t, 6> neighbour;  ///< of the first node
};

/// One colour of the nodes: those with all six neighbours, and those with less.
struct Colour {
  std::vector<Run> whole;
  std::vector<EdgeNode> edge;
};

bool continues(const Run& run, std::size_t node, const std::array<std::uint32_t, 6>& neighbour) {
  if (node != run.node + run.count || run.count == kLongestRun) return false;
  for (std::size_t d = 0; d < 6; ++d)
    if (neighbour[d] != run.neighbour[d] + run.count) return false;
  return true;
}

Colour colour_of(const WallGrid& grid, const WallGraph& graph, std::size_t first, std::size_t last) {
  Colour colour;
  for (std::size_t n = first; n < last; ++n) {
    const auto& to = graph.nodes[n].neighbour;
    if (!std::all_of(to.begin(), to.end(), [](std::uint32_t t) { return t < kInnerEnd; })) {
      colour.edge.push_back(edge_node(grid, graph, n));
      continue;
    }
    if (colour.whole.empty() || !continues(colour.whole.back(), n, to))
      colour.whole.push_back({static_cast<std::uint32_t>(n), 0, to});
    ++colour.whole.back().count;
  }
  return colour;
}

/// Over-relaxes the nodes of a run; returns the largest change. The largest is found among the bits, whose
/// order is that of the values, because that vectorises.
float relax(const Run& run, const std::array<float, 3>& share, std::vector<float>& u) {
  // Neighbours are of the other colour, so that what is written is not read.
  float* __restrict own = u.data() + run.node;
  std::array<const float*, 6> beside{};
  for (std::size_t d = 0; d < 6; ++d) beside[d] = u.data() + run.neighbour[d];
  std::int32_t most = 0;
  for (std::uint32_t i = 0; i < run.count; ++i) {
    const float mean = share[0] * (beside[0][i] + beside[1][i]) + share[1] * (beside[2][i] + beside[3][i]) +
                       share[2] * (beside[4][i] + beside[5][i]);
    const float step = kOmega * (mean - own[i]);
    own[i] += step;
    most = std::max(most, Eigen::numext::bit_cast<std::int32_t>(step) & 0x7fffffff);
  }
  return Eigen::numext::bit_cast<float>(most);
}

float relax(const EdgeNode& edge, std::vector<float>& u) {
  float mean = edge.constant;
  for (std::size_t d = 0; d < 6; ++d) mean += edge.weight[d] * u[edge.neighbour[d]];
  const float step = kOmega * (mean - u[edge.node]);
  u[edge.node] += step;
  return std::abs(step);
}

/// The grid of every other voxel; no wall at its border. What it says of distances is typical, not measured.
WallGrid every_other(const WallGrid& grid) {
  WallGrid coarse;
  for (std::size_t d = 0; d < 3; ++d) coarse.size[d] = (grid.size[d] + 1) / 2;
  coarse.index_to_mm = grid.index_to_mm;
  coarse.index_to_mm.topLeftCorner<3, 3>() *= 2;
  coarse.visit([&](int i, int j, int k, std::size_t) {
    const std::uint8_t kind = grid.kind[grid.offset(2 * i, 2 * j, 2 * k)];
    const bool open = kind == kWall && coarse.on_border(i, j, k);
    coarse.kind.push_back(open ? static_cast<std::uint8_t>(kSide) : kind);
  });
  coarse.distance_mm.assign(coarse.kind.size(), 1.F);
  return coarse;
}

/// Values to start from: the means of what the grid of every other voxel has around each node.
std::vector<float> start_values(const WallGrid& grid, const WallGraph& graph, int threads) {
  const WallGrid coarse = every_other(grid);
  const WallGraph coarse_graph = wall_graph(coarse, graph.inner_kind, threads);
  const std::vector<float> solved = wall_potential(coarse, coarse_graph, threads);
  std::vector<float> value(coarse.kind.size());
  for (std::size_t at = 0; at < value.size(); ++at)
    value[at] = coarse.kind[at] == graph.inner_kind ? 0.F : (coarse.kind[at] == kSide ? 0.5F : 1.F);
  for (std::size_t n = 0; n < solved.size(); ++n) value[coarse_graph.voxel[n]] = solved[n];
  std::vector<float> start(graph.nodes.size());
  parallel_for(threads, start.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t n = first; n < last; ++n) {
      const std::size_t at = graph.voxel[n], nx = graph.stride[1], ny = graph.stride[2] / nx;
      const std::array<std::size_t, 3> place{at % nx, at / nx % ny, at / graph.stride[2]};
      float sum = 0;
      for (std::size_t corner = 0; corner < 8; ++corner) {
        std::array<int, 3> c{};
        for (std::size_t d = 0; d < 3; ++d)
          c[d] = std::min(static_cast<int>((place[d] + (corner >> d & 1)) / 2), coarse.size[d] - 1);
        sum += value[coarse.offset(c[0], c[1], c[2])];
      }
      start[n] = sum / 8;
    }
  });
  return start;
}

/// The neighbours of the nodes [first, last), which are of one colour. Those in one direction are among
/// [other_first, other_last), the other colour, and in the order of the grid too, so that one walk along it
/// finds them all.
void link_nodes(const WallGrid& grid, std::size_t first, std::size_t last, std::size_t other_first,
                std::size_t other_last, WallGraph& graph) {
  if (first == last) return;
  const auto begin = graph.voxel.begin(), end = begin + static_cast<std::ptrdiff_t>(other_last);
  std::array<std::vector<std::size_t>::const_iterator, 6> walk;
  for (std::size_t d = 0; d < 6; ++d)
    walk[d] = std::lower_bound(begin + static_cast<std::ptrdiff_t>(other_first), end,
                               across(graph, graph.voxel[first], d));
  for (std::size_t n = first; n < last; ++n)
    for (std::size_t d = 0; d < 6; ++d) {
      const std::size_t other = across(graph, graph.voxel[n], d);
      const std::uint8_t kind = grid.kind[other];
      std::uint32_t& to = graph.nodes[n].neighbour[d];
      to = kind == graph.inner_kind ? kInnerEnd : kind == kSide || kind == kWall ? kSideEnd : kOuterEnd;
      if (kind != kWall) continue;
      while (walk[d] != end && *walk[d] < other) ++walk[d];
      if (walk[d] != end && *walk[d] == other) to = static_cast<std::uint32_t>(walk[d] - begin);
    }
}

}  // namespace

WallGraph wall_graph(const WallGrid& grid, std::uint8_t inner_kind, int threads,
                     const std::vector<std::uint8_t>& in_reach) {
  WallGraph graph;
  graph.inner_kind = inner_kind;
  graph.stride = grid.strides();
  for (std::size_t d = 0; d < 3; ++d) graph.step_mm[d] = grid.spacing_mm()[static_cast<int>(d)];
  for (const int parity : {0, 1}) {
    for (int k = 0; k < grid.size[2]; ++k)
      for (int j = 0; j < grid.size[1]; ++j)
        for (int i = (j + k + parity) % 2; i < grid.size[0]; i += 2) {
          const std::size_t at = grid.offset(i, j, k);
          if (grid.kind[at] == kWall && (in_reach.empty() || in_reach[at])) graph.voxel.push_back(at);
        }
    if (parity == 0) graph.even = graph.voxel.size();
  }
  graph.nodes.resize(graph.voxel.size());
  const std::size_t even = graph.even, all = graph.voxel.size();
  parallel_for(threads, even,
               [&](std::size_t first, std::size_t last) { link_nodes(grid, first, last, even, all, graph); });
  parallel_for(threads, all - even, [&](std::size_t first, std::size_t last) {
    link_nodes(grid, even + first, even + last, 0, even, graph);
  });
  return graph;
}

double step_to(const WallGrid& grid, const WallGraph& graph, std::size_t node, std::size_t direction) {
  const double step = graph.step_mm[direction / 2];
  const std::uint32_t to = graph.nodes[node].neighbour[direction];
  if (to < kInnerEnd) return step;
  if (to == kSideEnd) return step / 2;
  const std::size_t at = graph.voxel[node];
  const double inside = grid.distance_mm[at], outside = grid.distance_mm[across(graph, at, direction)];
  return step * std::max(inside / (inside + outside), kLeastStep);
}

std::vector<float> wall_potential(const WallGrid& grid, const WallGraph& graph, int threads) {
  const std::size_t count = graph.nodes.size();
  std::array<Colour, 2> colours;
  parallel_for(threads, 2, [&](std::size_t first, std::size_t last) {
    for (std::size_t c = first; c < last; ++c)
      colours[c] = colour_of(grid, graph, c == 0 ? 0 : graph.even, c == 0 ? graph.even : count);
  });
  const Eigen::Vector3d squares = grid.spacing_mm().array().square().inverse();
  std::array<float, 3> share{};
  for (std::size_t d = 0; d < 3; ++d)
    share[d] = static_cast<float>(squares[static_cast<int>(d)] / (2 * squares.sum()));

  std::vector<float> u =
      count < kFewNodes ? std::vector<float>(count, 0.5F) : start_values(grid, graph, threads);
  // The largest change is found part by part, so that it does not depend on the number of threads.
  constexpr std::size_t kParts = 16;
  std::array<float, kParts> change{};
  for (int round = 0; round < kMostSweeps; ++round) {
    float most = 0;
    for (const Colour& colour : colours) {
      parallel_for(threads, kParts, [&](std::size_t first, std::size_t last) {
        for (std::size_t part = first; part < last; ++part) {
          const auto begin = [&](std::size_t size, std::size_t p) { return size * p / kParts; };
          const std::size_t whole = colour.whole.size(), edge = colour.edge.size();
          float most_here = 0;
          for (std::size_t r = begin(whole, part); r < begin(whole, part + 1); ++r)
            most_here = std::max(most_here, relax(colour.whole[r], share, u));
          for (std::size_t e = begin(edge, part); e < begin(edge, part + 1); ++e)
            most_here = std::max(most_here, relax(colour.edge[e], u));
          change[part] = most_here;
        }
      });
      most = std::max(most, *std::max_element(change.begin(), change.end()));
    }
    if (most < kPotentialTolerance) break;
  }
  return u;
}

}  // namespace voxtet::wall
