// Clamped bi-Laplacian smoothing of displacements.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "surface/smooth/move_limits.h"
#include "surface/smooth/surface_graph.h"
#include "types/run_context.h"

namespace voxtet {

/// x <- clamp(x - step * L(L(x))), where L(x) is the mean of a vertex's neighbours minus itself (0 at fixed
/// vertices, which stay) and the clamp is that of `limits` around `start`. Displacements are held in single
/// precision. Identical for any number of threads. References must stay valid.
class BilaplacianSmoother {
 public:
  BilaplacianSmoother(const SurfaceGraph& graph, const std::vector<Eigen::Vector3d>& start,
                      const MoveLimits& limits, double step);

  /// Takes `iterations` steps from `points`, which are in index space like the start. If cancelled, returns
  /// false and leaves the points as they were.
  bool run(int iterations, const RunContext& ctx, std::vector<Eigen::Vector3d>& points);

 private:
  /// Three coordinates and a spare one, to fill a vector register where there are any.
  using Float4 = float __attribute__((vector_size(16)));

  void step_all(int threads);
  static Float4 to_float4(const Eigen::Vector3d& v);
  static Float4 umbrella(std::span<const std::uint32_t> row, const std::vector<Float4>& x, std::size_t v);

  const SurfaceGraph& graph_;
  const std::vector<Eigen::Vector3d>& start_;
  const MoveLimits& limits_;
  float step_;
  std::vector<std::uint32_t> movers_;
  std::array<Float4, MoveLimits::kKinds> low_{}, high_{};
  std::vector<Float4> of_start_, moved_, laplacian_;  ///< L(start); x - start; L(x)
};

}  // namespace voxtet
