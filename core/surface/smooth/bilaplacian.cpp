#include "surface/smooth/bilaplacian.h"

#include "base/parallel.h"

namespace voxtet {

BilaplacianSmoother::BilaplacianSmoother(const SurfaceGraph& graph, const std::vector<Eigen::Vector3d>& start,
                                         const MoveLimits& limits, double step)
    : graph_(graph),
      start_(start),
      limits_(limits),
      step_(static_cast<float>(step)),
      of_start_(start.size(), Float4{}),
      moved_(start.size(), Float4{}),
      laplacian_(start.size(), Float4{}) {
  for (std::size_t kind = 0; kind < MoveLimits::kKinds; ++kind) {
    low_[kind] = to_float4(limits.box_of_kind(kind).low);
    high_[kind] = to_float4(limits.box_of_kind(kind).high);
  }
  for (std::uint32_t v = 0; v < start.size(); ++v) {
    if (graph.kinds[v] == VertexKind::kFixed) continue;
    movers_.push_back(v);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::uint32_t other : graph.of(v)) sum += start[other] - start[v];
    of_start_[v] = to_float4(sum / static_cast<double>(graph.of(v).size()));
  }
}

bool BilaplacianSmoother::run(int iterations, const RunContext& ctx, std::vector<Eigen::Vector3d>& points) {
  for (const std::uint32_t v : movers_) moved_[v] = to_float4(points[v] - start_[v]);
  for (int iteration = 0; iteration < iterations; ++iteration) {
    if (ctx.cancelled()) return false;
    step_all(ctx.threads);
  }
  for (const std::uint32_t v : movers_) {
    const MoveLimits::Box& box = limits_.box(v);
    const Eigen::Vector3d move(moved_[v][0], moved_[v][1], moved_[v][2]);
    points[v] = start_[v] + move.cwiseMax(box.low).cwiseMin(box.high);
  }
  return true;
}

void BilaplacianSmoother::step_all(int threads) {
  parallel_for(threads, movers_.size(), [this](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const std::uint32_t v = movers_[i];
      laplacian_[v] = of_start_[v] + umbrella(graph_.of(v), moved_, v);
    }
  });
  parallel_for(threads, movers_.size(), [this](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const std::uint32_t v = movers_[i];
      const Float4 &low = low_[limits_.kind(v)], &high = high_[limits_.kind(v)];
      const Float4 wanted = moved_[v] - step_ * umbrella(graph_.of(v), laplacian_, v);
      const Float4 raised = wanted < low ? low : wanted;
      moved_[v] = raised > high ? high : raised;
    }
  });
}

BilaplacianSmoother::Float4 BilaplacianSmoother::to_float4(const Eigen::Vector3d& v) {
  return Float4{static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()), 0.F};
}

BilaplacianSmoother::Float4 BilaplacianSmoother::umbrella(std::span<const std::uint32_t> row,
                                                          const std::vector<Float4>& x, std::size_t v) {
  Float4 sum = x[row[0]];
  for (std::size_t i = 1; i < row.size(); ++i) sum += x[row[i]];
  return sum * (1.F / static_cast<float>(row.size())) - x[v];
}

}  // namespace voxtet
