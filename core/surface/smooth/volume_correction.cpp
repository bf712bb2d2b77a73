#include "surface/smooth/volume_correction.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace voxtet {
namespace {

using Points = std::vector<Eigen::Vector3d>;

using RegionPair = std::array<std::uint32_t, 2>;

constexpr int kRounds = 8;
constexpr double kGoodEnough = 1e-4;    ///< relative error of a region's volume, beside
constexpr double kSmallVolume = 0.01;   ///< voxels
constexpr double kLargestShift = 0.25;  ///< voxels a round: beyond, the first-order prediction is worthless

constexpr double kStopped = 0.5;  ///< part of a shift below which its point counts as stopped
constexpr std::size_t kSolverSteps = 300;

/// Which two regions meet at each movable vertex: an entry of `pairs`.
struct Interfaces {
  std::vector<RegionPair> pairs;
  std::vector<std::uint32_t> of_vertex;
};

Interfaces find_interfaces(const CorrectionProblem& problem, const Flags& movable) {
  Interfaces found;
  for (const RegionPair& pair : problem.regions)
    if (found.pairs.empty() || found.pairs.back() != pair) found.pairs.push_back(pair);
  std::sort(found.pairs.begin(), found.pairs.end());
  found.pairs.erase(std::unique(found.pairs.begin(), found.pairs.end()), found.pairs.end());
  found.of_vertex.assign(movable.size(), 0);
  RegionPair last{};
  std::uint32_t last_at = 0;
  for (std::size_t t = 0; t < problem.regions.size(); ++t) {
    const RegionPair& pair = problem.regions[t];
    if (pair != last || t == 0) {
      last = pair;
      last_at = static_cast<std::uint32_t>(std::lower_bound(found.pairs.begin(), found.pairs.end(), pair) -
                                           found.pairs.begin());
    }
    for (const std::uint32_t v : problem.surface.triangles[t]) found.of_vertex[v] = last_at;
  }
  return found;
}

/// Volume by region, and at each vertex the gradient of the volume behind it.
void measure(const CorrectionProblem& problem, const Points& points, std::vector<double>& volumes,
             Points& gradients) {
  std::fill(volumes.begin(), volumes.end(), 0.0);
  std::fill(gradients.begin(), gradients.end(), Eigen::Vector3d::Zero());
  const Eigen::Vector3d reference = points.front();
  for (std::size_t t = 0; t < problem.regions.size(); ++t) {
    const Triangle& v = problem.surface.triangles[t];
    const Eigen::Vector3d a = points[v[0]] - reference;
    const Eigen::Vector3d cross =
        (problem.orientation / 6) * (points[v[1]] - points[v[0]]).cross(points[v[2]] - points[v[0]]);
    const double volume = a.dot(cross);
    volumes[problem.regions[t][0]] += volume;
    volumes[problem.regions[t][1]] -= volume;
    for (const std::uint32_t corner : v) gradients[corner] += cross;
  }
}

/// Graph Laplacian of the regions, weighted by interface area, the outside grounded.
class RegionSystem {
 public:
  RegionSystem(const std::vector<RegionPair>& pairs, const std::vector<double>& areas, std::size_t regions)
      : pairs_(pairs), areas_(areas), diagonal_(regions, 0.0) {
    for (std::size_t p = 0; p < pairs.size(); ++p)
      for (const std::uint32_t region : pairs[p]) diagonal_[region] += areas[p];
    diagonal_[VoxelRegions::kOutside] = 0;
  }

  /// Jacobi-preconditioned conjugate gradients. Regions that cannot move keep lambda 0.
  std::vector<double> solve(std::vector<double> residual) const {
    const std::size_t n = diagonal_.size();
    std::vector<double> lambda(n, 0.0), direction(n, 0.0), image(n, 0.0);
    for (std::size_t l = 0; l < n; ++l)
      if (diagonal_[l] <= 0) residual[l] = 0;
    double rho = 0, start = 0;
    for (std::size_t iteration = 0; iteration < std::min<std::size_t>(2 * n + 20, kSolverSteps);
         ++iteration) {
      double next = 0;
      for (std::size_t l = 0; l < n; ++l)
        if (diagonal_[l] > 0) next += residual[l] * residual[l] / diagonal_[l];
      if (iteration == 0) start = next;
      if (!(next > 1e-20 * start)) break;
      const double beta = iteration == 0 ? 0 : next / rho;
      rho = next;
      for (std::size_t l = 0; l < n; ++l)
        direction[l] = (diagonal_[l] > 0 ? residual[l] / diagonal_[l] : 0) + beta * direction[l];
      apply(direction, image);
      double curvature = 0;
      for (std::size_t l = 0; l < n; ++l) curvature += direction[l] * image[l];
      if (!(curvature > 0)) break;
      const double alpha = rho / curvature;
      for (std::size_t l = 0; l < n; ++l) {
        lambda[l] += alpha * direction[l];
        residual[l] -= alpha * image[l];
      }
    }
    return lambda;
  }

 private:
  void apply(const std::vector<double>& x, std::vector<double>& out) const {
    // A little more than the diagonal keeps groups of regions without a movable way to the outside solvable.
    for (std::size_t l = 0; l < x.size(); ++l) out[l] = 1e-9 * diagonal_[l] * x[l];
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      const double flow = areas_[p] * (x[pairs_[p][0]] - x[pairs_[p][1]]);
      out[pairs_[p][0]] += flow;
      out[pairs_[p][1]] -= flow;
    }
    out[VoxelRegions::kOutside] = 0;
  }

  const std::vector<RegionPair>& pairs_;
  const std::vector<double>& areas_;
  std::vector<double> diagonal_;
};

}  // namespace

bool correct_volumes(const CorrectionProblem& problem, const std::vector<CrossingLimit>& crossings,
                     const RunContext& ctx, Flags& movable, Points& points) {
  const Interfaces interfaces = find_interfaces(problem, movable);
  const std::size_t regions = problem.target.size();
  std::vector<double> volumes(regions), missing(regions), areas(interfaces.pairs.size());
  Points gradients(points.size());
  for (int round = 0; round < kRounds; ++round) {
    if (ctx.cancelled()) return false;
    measure(problem, points, volumes, gradients);
    bool done = true;
    for (std::size_t r = 0; r < regions; ++r) {
      missing[r] = r == VoxelRegions::kOutside ? 0 : problem.target[r] - volumes[r];
      done = done && std::abs(missing[r]) <= kGoodEnough * problem.target[r] + kSmallVolume;
    }
    if (done) return true;
    std::fill(areas.begin(), areas.end(), 0.0);
    for (std::size_t v = 0; v < points.size(); ++v)
      if (movable[v]) areas[interfaces.of_vertex[v]] += gradients[v].norm();
    const std::vector<double> lambda = RegionSystem(interfaces.pairs, areas, regions).solve(missing);
    for (std::size_t v = 0; v < points.size(); ++v) {
      const double area = gradients[v].norm();
      if (!movable[v] || !(area > 0)) continue;
      const RegionPair& pair = interfaces.pairs[interfaces.of_vertex[v]];
      const double length = std::clamp(lambda[pair[0]] - lambda[pair[1]], -kLargestShift, kLargestShift);
      const Eigen::Vector3d shift = (length / area) * gradients[v];
      const MoveLimits::Box& box = problem.limits.box(v);
      const Eigen::Vector3d before = points[v];
      const Eigen::Vector3d wanted = crossings[v].clamped(before + shift - problem.start[v]);
      points[v] = problem.start[v] + wanted.cwiseMax(box.low).cwiseMin(box.high);
      if (shift.dot(points[v] - before) < kStopped * shift.squaredNorm()) movable[v] = 0;
    }
  }
  return true;
}

}  // namespace voxtet
