// Clamped bi-Laplacian smoothing of displacements, with momentum.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/repair/retreat.h"
#include "surface/smooth/crossing_limits.h"
#include "surface/smooth/move_limits.h"
#include "surface/smooth/surface_graph.h"
#include "types/run_context.h"

namespace voxtet {

/// y <- x + s (x - last x), x <- clamp(y - step * L(L(y))), where L(x) is the mean of a vertex's neighbours
/// minus itself (0 at fixed vertices, which stay), and the clamp is that of `limits` around `start`, and of
/// the crossings where they are limited. The share s of the last step is k / (k + 3) after k steps
/// (Nesterov, "A method of solving a convex programming problem with convergence rate O(1/k^2)", 1983), which
/// are counted anew every hundred steps: so k steps reach as far as some k^2 / 12 steps without it. Along
/// junctions, where L has eigenvalues down to -2, steps are shorter, as momentum needs. Displacements are
/// held in single precision. Identical for any number of threads. References must stay valid.
class BilaplacianSmoother {
 public:
  BilaplacianSmoother(const SurfaceGraph& graph, const std::vector<Eigen::Vector3d>& start,
                      const MoveLimits& limits, double step);

  /// From now on these vertices stay.
  void fix(const Flags& vertices);
  /// From now on the steps keep to these limits, one for each vertex.
  void limit_crossings(const std::vector<CrossingLimit>& limits);

  /// Takes `iterations` steps from `points`, which are in index space like the start. Points that are where
  /// the last call left them keep their momentum. If cancelled, returns false and leaves the points as they
  /// were.
  bool run(int iterations, const RunContext& ctx, std::vector<Eigen::Vector3d>& points);

 private:
  /// Three coordinates and a spare one, to fill a vector register where there are any.
  using Float4 = float __attribute__((vector_size(16)));

  void step_all(int threads);
  Float4 clamped(std::uint32_t vertex, Float4 moved) const;
  static Float4 to_float4(const Eigen::Vector3d& v);
  static Float4 umbrella(std::span<const std::uint32_t> row, const std::vector<Float4>& x, std::size_t v);

  const SurfaceGraph& graph_;
  const std::vector<Eigen::Vector3d>& start_;
  const MoveLimits& limits_;
  float step_;
  int steps_ = 0;  ///< since the momentum began
  std::vector<std::uint32_t> movers_;
  std::array<Float4, MoveLimits::kKinds> low_{}, high_{};
  std::vector<Float4> of_start_, laplacian_;  ///< L(start); L(y)
  std::vector<Float4> moved_, ahead_;         ///< x - start; y - start
  std::vector<Float4> crossings_;             ///< normal and reach of each limit; empty: none
};

}  // namespace voxtet
