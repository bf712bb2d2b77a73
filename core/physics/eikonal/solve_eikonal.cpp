#include "physics/eikonal/solve_eikonal.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

#include "base/buckets.h"
#include "physics/eikonal/check_eikonal.h"
#include "physics/eikonal/local_arrival.h"
#include "types/stage_names.h"

namespace voxtet::eikonal {
namespace {

constexpr double kTolerance = 1e-9;  ///< ms, by which a value must be earlier to count
constexpr double kNotReached = std::numeric_limits<double>::infinity();
/// Points worked on, some milliseconds of them, between two looks at the context.
constexpr std::size_t kPointsPerQuestion = 2000;

SquaredEdgeTimes squared_edge_times(const TetMesh& mesh, const Tissue& tissue, std::size_t t) {
  // C^-1 = across^-2 I + (along^-2 - across^-2) f f^T, over the share.
  const TissueKind& kind = tissue.kinds[tissue.kind[t]];
  const bool isotropic = tissue.fibre.empty() || kind.along_mm_per_ms == kind.across_mm_per_ms;
  const double share = tissue.share.empty() ? 1 : tissue.share[t];
  const double along = 1 / (share * kind.along_mm_per_ms * kind.along_mm_per_ms);
  const double across = isotropic ? along : 1 / (share * kind.across_mm_per_ms * kind.across_mm_per_ms);
  SquaredEdgeTimes squared{};
  std::size_t edge = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) {
      const Eigen::Vector3d e = mesh.points[mesh.tets[t][j]] - mesh.points[mesh.tets[t][i]];
      const double on_fibre = isotropic ? 0 : tissue.fibre[t].dot(e);
      squared[edge++] = across * e.squaredNorm() + (along - across) * (on_fibre * on_fibre);
    }
  return squared;
}

/// Points whose time still changes are active, and are worked on in sweeps; one whose time has settled makes
/// those active that it reaches earlier. The order is that in which points became active.
class FastIterativeMethod {
 public:
  FastIterativeMethod(const TetMesh& mesh, const Tissue& tissue)
      : tets_(mesh.tets),
        edges_(mesh.tets.size()),
        at_point_(mesh.points.size()),
        times_(mesh.points.size(), kNotReached),
        active_(mesh.points.size(), false) {
    for (std::size_t t = 0; t < tets_.size(); ++t) {
      if (tissue.kind[t] == Tissue::kNone) continue;
      edges_[t] = squared_edge_times(mesh, tissue, t);
      for (const std::uint32_t point : tets_[t]) at_point_.count(point);
    }
    at_point_.allocate();
    for (std::uint32_t t = 0; t < tets_.size(); ++t)
      if (tissue.kind[t] != Tissue::kNone)
        for (const std::uint32_t point : tets_[t]) at_point_.add(point, t);
  }

  Status run(std::span<const EikonalSource> sources, RunContext& ctx) {
    for (const auto& [point, time_ms] : sources) times_[point] = std::min(times_[point], time_ms);
    for (const EikonalSource& source : sources) wake_neighbours(source.point);
    std::vector<std::uint32_t> list;
    for (std::size_t worked = 0; !next_.empty();) {
      list.swap(next_);
      next_.clear();
      for (const std::uint32_t point : list) {
        if (worked++ % kPointsPerQuestion == 0) {
          if (ctx.cancelled()) return cancelled_error(kEikonalStage);
          ctx.progress(kEikonalStage, static_cast<double>(reached_) / static_cast<double>(times_.size()));
        }
        work_on(point);
      }
    }
    ctx.progress(kEikonalStage, 1);
    return std::monostate{};
  }

  std::vector<double> release() { return std::move(times_); }

 private:
  void work_on(std::uint32_t point) {
    double earliest = times_[point];
    for (const std::uint32_t t : at_point_.at(point)) {
      const auto corner = std::find(tets_[t].begin(), tets_[t].end(), point) - tets_[t].begin();
      earliest = std::min(earliest, arrival(t, static_cast<std::size_t>(corner)));
    }
    const bool changed = earliest < times_[point] - kTolerance;
    times_[point] = earliest;
    if (changed) {
      next_.push_back(point);
    } else {
      active_[point] = false;
      wake_neighbours(point);
    }
  }

  /// Makes those active that the wave reaches earlier by a tetrahedron of this point.
  void wake_neighbours(std::uint32_t point) {
    for (const std::uint32_t t : at_point_.at(point))
      for (std::size_t corner = 0; corner < 4; ++corner) {
        const std::uint32_t other = tets_[t][corner];
        if (other == point || active_[other]) continue;
        const double earliest = arrival(t, corner);
        if (!(earliest < times_[other] - kTolerance)) continue;
        if (times_[other] == kNotReached) ++reached_;
        times_[other] = earliest;
        active_[other] = true;
        next_.push_back(other);
      }
  }

  double arrival(std::uint32_t t, std::size_t corner) const {
    const auto& [a, b, c, d] = tets_[t];
    const std::array<double, 4> times{times_[a], times_[b], times_[c], times_[d]};
    // Nothing comes to the earliest corner from the others.
    if (times[corner] <= *std::min_element(times.begin(), times.end())) return kNotReached;
    return local_arrival(edges_[t], corner, times);
  }

  std::span<const Tet> tets_;
  std::vector<SquaredEdgeTimes> edges_;  ///< of tetrahedra that conduct
  Buckets<std::uint32_t> at_point_;      ///< the tetrahedra that conduct at each point
  std::vector<double> times_;
  std::vector<bool> active_;         ///< whether a point is in the list that is worked on, or in next_
  std::vector<std::uint32_t> next_;  ///< points to work on in the next sweep
  std::size_t reached_ = 0;          ///< points that have a time, without the sources
};

}  // namespace
}  // namespace voxtet::eikonal

namespace voxtet {

Result<std::vector<double>> solve_eikonal(const TetMesh& mesh, const Tissue& tissue,
                                          std::span<const EikonalSource> sources, RunContext& ctx) {
  if (auto error = eikonal::check_input(mesh, tissue, sources)) return *std::move(error);
  eikonal::FastIterativeMethod method(mesh, tissue);
  if (Status done = method.run(sources, ctx); !done) return done.error();
  std::vector<double> times = method.release();
  for (double& time : times)
    if (time == eikonal::kNotReached) time = std::numeric_limits<double>::quiet_NaN();
  return times;
}

}  // namespace voxtet
