// Where relocation would like a vertex to be.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/elements/surface_measures.h"
#include "geometry/elements/triangle_measures.h"
#include "remesh/adapt/local_operations.h"

namespace voxtet::remesh {
namespace {

constexpr double kOwnWeight = 0.1;      ///< of the vertex itself among the samples, where there are few
constexpr double kLargestOffset = 0.8;  ///< of the envelope, in one step

}  // namespace

/// Along the surface: tangential_relaxation(), where angles or folds shall open by shapes alone, weighted by
/// how poor they are. Across it: the height that fits the samples.
Eigen::Vector3d LocalOperations::surface_target(std::uint32_t v, Demand demand, double step,
                                                std::uint32_t& hint) const {
  const ComplexMesh& mesh = editor_.mesh();
  const Eigen::Vector3d& x = mesh.point(v);
  std::vector<RingTriangle> ring;
  ring.reserve(mesh.star(v).size());
  for (const std::uint32_t t : mesh.star(v)) {
    const Triangle& c = mesh.triangle(t);
    const std::size_t at = c[0] == v ? 0 : c[1] == v ? 1 : 2;
    ring.push_back({mesh.point(c[(at + 1) % 3]), mesh.point(c[(at + 2) % 3]), target_area(c)});
    if (demand == Demand::kAllowed) continue;
    const double open = 1.001 - sharpest_cosine({x, ring.back().p, ring.back().q});
    ring.back().need = 1 / (open * open);
  }
  const TangentialStep to = tangential_relaxation(x, ring, demand == Demand::kAllowed ? shape_weight : 1);
  return fit_height(v, x + step * to.step, to.normal, hint);
}

/// In squares of the target edge length.
double LocalOperations::target_area(const Triangle& t) const {
  const double target = editor_.size(t[0]) + editor_.size(t[1]) + editor_.size(t[2]);
  return target * target;
}

/// Moves `at` along the normal so that the facets from it to the link pass between the samples in the sense
/// of least squares, each sample weighted by its share of the reference's area: volumes and mean distance are
/// kept, which facets with all their corners on a convex reference would not.
Eigen::Vector3d LocalOperations::fit_height(std::uint32_t v, const Eigen::Vector3d& at,
                                            const Eigen::Vector3d& normal, std::uint32_t& hint) const {
  const ComplexMesh& mesh = editor_.mesh();
  const ReferenceSurface& reference = editor_.reference();
  const PairId pair = mesh.pair(mesh.star(v).front());
  const Eigen::Vector3d on = reference.walk(at, pair, hint) + offsets[pair] * normal;
  double area = 0, above = 0, weight = 0;
  for (const std::uint32_t t : mesh.star(v)) {
    const Triangle& c = mesh.triangle(t);
    const std::size_t k = c[0] == v ? 0 : c[1] == v ? 1 : 2;
    const Eigen::Vector3d &p = mesh.point(c[(k + 1) % 3]), &q = mesh.point(c[(k + 2) % 3]);
    const Eigen::Vector3d cross = triangle_cross(at, p, q);
    const double size2 = cross.squaredNorm(), facing = cross.dot(normal);
    area += 0.5 * std::sqrt(size2);
    if (!(facing > 0.3 * std::sqrt(size2))) continue;
    editor_.samples().for_samples(t, [&](std::uint32_t s) {
      const Eigen::Vector3d off = reference.point(s) - p;
      // The share of the apex in the point of the facet below the sample.
      const double share = (q - p).cross(off).dot(cross) / size2;
      if (share <= 0 || share > 1) return;
      const double height = off.dot(cross) / facing + offsets[pair];
      above += reference.area(s) * share * height;
      weight += reference.area(s) * share * share;
    });
  }
  const double own = kOwnWeight * area / 3;
  above += own * (on - at).dot(normal);
  weight += own;
  const double offset = (on - at).dot(normal), most = kLargestOffset * editor_.limits.reach_mm;
  return at + std::clamp(above / weight, offset - most, offset + most) * normal;
}

/// Between the two neighbours, equally far in target edge lengths; then aside, so that the two edges pass
/// between the samples of the curve in the sense of least squares.
Eigen::Vector3d LocalOperations::curve_target(std::uint32_t v, std::uint32_t p, std::uint32_t q, double step,
                                              std::uint32_t& hint) const {
  const ComplexMesh& mesh = editor_.mesh();
  const ReferenceSurface& reference = editor_.reference();
  const Eigen::Vector3d x = mesh.point(v);
  const double to_p = editor_.metric_length(v, p), to_q = editor_.metric_length(v, q);
  const Eigen::Vector3d toward = to_p > to_q ? mesh.point(p) : mesh.point(q);
  const double along = 0.5 * std::abs(to_p - to_q) / std::max(to_p, to_q);
  const Eigen::Vector3d on = reference.walk_curve(x + step * along * (toward - x), hint);
  Eigen::Vector3d aside = Eigen::Vector3d::Zero();
  double weight = kOwnWeight;
  for (const std::uint32_t end : {p, q}) {
    const Eigen::Vector3d edge = on - mesh.point(end);
    const double size2 = edge.squaredNorm();
    if (!(size2 > 0)) continue;
    editor_.samples().for_curve_samples(v, end, [&](std::uint32_t s) {
      const Eigen::Vector3d off = reference.point(s) - mesh.point(end);
      const double share = off.dot(edge) / size2;
      if (share <= 0 || share > 1) return;
      aside += share * (off - share * edge);
      weight += share * share;
    });
  }
  aside /= weight;
  const double most = kLargestOffset * editor_.limits.reach_mm, length = aside.norm();
  return on + (length > most ? most / length : 1) * aside;
}

}  // namespace voxtet::remesh
