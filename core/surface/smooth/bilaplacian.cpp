#include "surface/smooth/bilaplacian.h"

#include "base/parallel.h"

namespace voxtet {
namespace {

constexpr int kStepsOfMomentum = 100;
constexpr float kJunctionShare = 0.65F;  ///< of the step

}  // namespace

BilaplacianSmoother::BilaplacianSmoother(const SurfaceGraph& graph, const std::vector<Eigen::Vector3d>& start,
                                         const MoveLimits& limits, double step)
    : graph_(graph),
      start_(start),
      limits_(limits),
      step_(static_cast<float>(step)),
      of_start_(start.size(), Float4{}),
      laplacian_(start.size(), Float4{}),
      moved_(start.size(), Float4{}),
      ahead_(start.size(), Float4{}) {
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

void BilaplacianSmoother::fix(const Flags& vertices) {
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (!vertices[v]) continue;
    ahead_[v] = moved_[v];
    laplacian_[v] = Float4{};
  }
  std::erase_if(movers_, [&](std::uint32_t v) { return vertices[v] != 0; });
}

void BilaplacianSmoother::limit_crossings(const std::vector<CrossingLimit>& limits) {
  crossings_.resize(limits.size());
  for (std::size_t v = 0; v < limits.size(); ++v) {
    crossings_[v] = to_float4(limits[v].normal);
    crossings_[v][3] = static_cast<float>(limits[v].reach);
  }
}

bool BilaplacianSmoother::run(int iterations, const RunContext& ctx, std::vector<Eigen::Vector3d>& points) {
  for (const std::uint32_t v : movers_) {
    const Float4 moved = to_float4(points[v] - start_[v]);
    if (moved[0] == moved_[v][0] && moved[1] == moved_[v][1] && moved[2] == moved_[v][2]) continue;
    moved_[v] = ahead_[v] = moved;
  }
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
      laplacian_[v] = of_start_[v] + umbrella(graph_.of(v), ahead_, v);
    }
  });
  steps_ = steps_ % kStepsOfMomentum + 1;
  const float momentum = static_cast<float>(steps_) / static_cast<float>(steps_ + 3);
  parallel_for(threads, movers_.size(), [this, momentum](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const std::uint32_t v = movers_[i];
      const float step = graph_.kinds[v] == VertexKind::kJunction ? kJunctionShare * step_ : step_;
      const Float4 now = clamped(v, ahead_[v] - step * umbrella(graph_.of(v), laplacian_, v));
      ahead_[v] = now + momentum * (now - moved_[v]);
      moved_[v] = now;
    }
  });
}

BilaplacianSmoother::Float4 BilaplacianSmoother::clamped(std::uint32_t vertex, Float4 moved) const {
  if (!crossings_.empty()) {
    const Float4& limit = crossings_[vertex];
    const float along = limit[0] * moved[0] + limit[1] * moved[1] + limit[2] * moved[2];
    const float beyond = along > limit[3] ? along - limit[3] : along < -limit[3] ? along + limit[3] : 0.F;
    moved -= Float4{limit[0], limit[1], limit[2], 0.F} * beyond;
  }
  const Float4 &low = low_[limits_.kind(vertex)], &high = high_[limits_.kind(vertex)];
  const Float4 raised = moved < low ? low : moved;
  return raised > high ? high : raised;
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
