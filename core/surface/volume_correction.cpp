#include "surface/volume_correction.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace voxtet {
namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr int kRounds = 3;
constexpr double kGoodEnough = 1e-4;    ///< relative volume error at which a round is not worth its time
constexpr double kLargestShift = 0.25;  ///< voxels a round: beyond, the first-order prediction is worthless

/// Which two labels meet at each surface vertex: an entry of `pairs`, or -1.
struct Interfaces {
  std::vector<Sides> pairs;
  std::vector<std::int32_t> of_vertex;
};

Interfaces find_interfaces(const SurfaceMesh& surface, const SurfaceGraph& graph) {
  Interfaces found;
  for (const Sides& sides : surface.sides)
    if (found.pairs.empty() || found.pairs.back() != sides) found.pairs.push_back(sides);
  std::sort(found.pairs.begin(), found.pairs.end());
  found.pairs.erase(std::unique(found.pairs.begin(), found.pairs.end()), found.pairs.end());
  found.of_vertex.assign(graph.kinds.size(), -1);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (const std::uint32_t v : surface.triangles[t]) {
      if (graph.kinds[v] != VertexKind::kSurface || found.of_vertex[v] >= 0) continue;
      const auto at = std::lower_bound(found.pairs.begin(), found.pairs.end(), surface.sides[t]);
      found.of_vertex[v] = static_cast<std::int32_t>(at - found.pairs.begin());
    }
  return found;
}

/// Volume by label, and at each vertex the gradient of the volume behind it.
void measure(const SurfaceMesh& surface, const Points& points, double orientation,
             std::vector<double>& volumes, Points& gradients) {
  std::fill(volumes.begin(), volumes.end(), 0.0);
  std::fill(gradients.begin(), gradients.end(), Eigen::Vector3d::Zero());
  const Eigen::Vector3d reference = points.front();
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Triangle& v = surface.triangles[t];
    const Eigen::Vector3d a = points[v[0]] - reference;
    const Eigen::Vector3d cross =
        (orientation / 6) * (points[v[1]] - points[v[0]]).cross(points[v[2]] - points[v[0]]);
    const double volume = a.dot(cross);
    volumes[surface.sides[t][0]] += volume;
    volumes[surface.sides[t][1]] -= volume;
    for (const std::uint32_t corner : v) gradients[corner] += cross;
  }
}

/// Graph Laplacian of the labels, weighted by interface area, background grounded.
class LabelSystem {
 public:
  LabelSystem(const std::vector<Sides>& pairs, const std::vector<double>& areas, std::size_t labels)
      : pairs_(pairs), areas_(areas), diagonal_(labels, 0.0) {
    for (std::size_t p = 0; p < pairs.size(); ++p)
      for (const Label label : pairs[p]) diagonal_[label] += areas[p];
    diagonal_[kBackground] = 0;
  }

  /// Jacobi-preconditioned conjugate gradients. Labels that cannot move keep lambda 0.
  std::vector<double> solve(std::vector<double> residual) const {
    const std::size_t n = diagonal_.size();
    std::vector<double> lambda(n, 0.0), direction(n, 0.0), image(n, 0.0);
    for (std::size_t l = 0; l < n; ++l)
      if (diagonal_[l] <= 0) residual[l] = 0;
    double rho = 0, start = 0;
    for (std::size_t iteration = 0; iteration < 2 * n + 20; ++iteration) {
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
    // A little more than the diagonal keeps groups of labels without a movable way to background solvable.
    for (std::size_t l = 0; l < x.size(); ++l) out[l] = 1e-9 * diagonal_[l] * x[l];
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      const double flow = areas_[p] * (x[pairs_[p][0]] - x[pairs_[p][1]]);
      out[pairs_[p][0]] += flow;
      out[pairs_[p][1]] -= flow;
    }
    out[kBackground] = 0;
  }

  const std::vector<Sides>& pairs_;
  const std::vector<double>& areas_;
  std::vector<double> diagonal_;
};

}  // namespace

void correct_volumes(const SurfaceMesh& surface, const SurfaceGraph& graph, const std::vector<double>& target,
                     double orientation, double max_move, const Points& start, Points& points) {
  const Interfaces interfaces = find_interfaces(surface, graph);
  std::vector<double> volumes(target.size()), missing(target.size()), areas(interfaces.pairs.size());
  std::vector<bool> present(target.size(), false);
  for (const Sides& sides : interfaces.pairs) present[sides[0]] = present[sides[1]] = true;
  present[kBackground] = false;
  Points gradients(points.size());
  for (int round = 0; round < kRounds; ++round) {
    measure(surface, points, orientation, volumes, gradients);
    bool done = true;
    for (std::size_t l = 0; l < target.size(); ++l) {
      missing[l] = present[l] ? target[l] - volumes[l] : 0;
      done = done && std::abs(missing[l]) <= kGoodEnough * target[l];
    }
    if (done) return;
    std::fill(areas.begin(), areas.end(), 0.0);
    for (std::size_t v = 0; v < points.size(); ++v)
      if (interfaces.of_vertex[v] >= 0)
        areas[static_cast<std::size_t>(interfaces.of_vertex[v])] += gradients[v].norm();
    const std::vector<double> lambda = LabelSystem(interfaces.pairs, areas, target.size()).solve(missing);
    for (std::size_t v = 0; v < points.size(); ++v) {
      if (interfaces.of_vertex[v] < 0) continue;
      const double area = gradients[v].norm();
      if (!(area > 0)) continue;
      const Sides& pair = interfaces.pairs[static_cast<std::size_t>(interfaces.of_vertex[v])];
      const double shift = std::clamp(lambda[pair[0]] - lambda[pair[1]], -kLargestShift, kLargestShift);
      points[v] += (shift / area) * gradients[v];
      points[v] = points[v].cwiseMax((start[v].array() - max_move).matrix());
      points[v] = points[v].cwiseMin((start[v].array() + max_move).matrix());
    }
  }
}

}  // namespace voxtet
