#include "surface/bilaplacian.h"

#include <array>
#include <cstdint>

#include "geometry/parallel.h"

namespace voxtet {
namespace {

/// Coordinates and a spare one: whole registers where there are any.
using Float4 = float __attribute__((vector_size(16)));

Float4 to_float4(const Eigen::Vector3d& v) {
  return Float4{static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()), 0.F};
}

Float4 clamp(const Float4& x, const Float4& low, const Float4& high) {
  const Float4 raised = x < low ? low : x;
  return raised > high ? high : raised;
}

Float4 umbrella(std::span<const std::uint32_t> row, const std::vector<Float4>& x, std::size_t v) {
  Float4 sum = x[row[0]];
  for (std::size_t i = 1; i < row.size(); ++i) sum += x[row[i]];
  return sum * (1.F / static_cast<float>(row.size())) - x[v];
}

/// L of the start, in double precision since the displacements are what is left of large numbers.
std::vector<Float4> start_laplacian(const SurfaceGraph& graph, const std::vector<Eigen::Vector3d>& start,
                                    const std::vector<std::uint32_t>& movers) {
  std::vector<Float4> laplacian(start.size(), Float4{});
  for (const std::uint32_t v : movers) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::uint32_t other : graph.of(v)) sum += start[other] - start[v];
    laplacian[v] = to_float4(sum / static_cast<double>(graph.of(v).size()));
  }
  return laplacian;
}

}  // namespace

std::vector<Eigen::Vector3d> smooth_bilaplacian(const SurfaceGraph& graph,
                                                const std::vector<Eigen::Vector3d>& start,
                                                const MoveLimits& limits, int iterations, double step,
                                                const RunContext& ctx) {
  std::vector<std::uint32_t> movers;
  for (std::uint32_t v = 0; v < start.size(); ++v)
    if (graph.kinds[v] != VertexKind::kFixed) movers.push_back(v);
  std::array<Float4, MoveLimits::kKinds> low{}, high{};
  for (std::size_t kind = 0; kind < MoveLimits::kKinds; ++kind) {
    low[kind] = to_float4(limits.box_of_kind(kind).low);
    high[kind] = to_float4(limits.box_of_kind(kind).high);
  }
  const std::vector<Float4> of_start = start_laplacian(graph, start, movers);
  std::vector<Float4> moved(start.size(), Float4{}), laplacian(start.size(), Float4{});
  const auto mu = static_cast<float>(step);
  for (int iteration = 0; iteration < iterations; ++iteration) {
    if (ctx.cancelled()) return {};
    ctx.progress("smooth", 0.9 * iteration / iterations);
    parallel_for(ctx.threads, movers.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const std::uint32_t v = movers[i];
        laplacian[v] = of_start[v] + umbrella(graph.of(v), moved, v);
      }
    });
    parallel_for(ctx.threads, movers.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const std::uint32_t v = movers[i];
        const std::uint8_t kind = limits.kind(v);
        moved[v] = clamp(moved[v] - mu * umbrella(graph.of(v), laplacian, v), low[kind], high[kind]);
      }
    });
  }
  std::vector<Eigen::Vector3d> points = start;
  for (const std::uint32_t v : movers) {
    const MoveLimits::Box& box = limits.box(v);
    const Eigen::Vector3d move(moved[v][0], moved[v][1], moved[v][2]);
    points[v] += move.cwiseMax(box.low).cwiseMin(box.high);
  }
  return points;
}

}  // namespace voxtet
