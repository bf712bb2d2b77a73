#include "remesh/delaunay/relax_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "base/buckets.h"
#include "geometry/elements/surface_measures.h"
#include "geometry/elements/triangle_measures.h"
#include "remesh/delaunay/fit_surface.h"
#include "remesh/motion/tangential_relaxation.h"

namespace voxtet::remesh {
namespace {

using Eigen::Vector3d;

constexpr int kRelaxRounds = 4;
constexpr double kShapeWeight = 0.5;
constexpr double kBentCosine = 0.87;  ///< to the mean normal around a point: bent where one has less
constexpr double kTurnCosine = 0.98;

/// The other two corners, in order.
struct Opposite {
  std::uint32_t p, q, triangle;
};

class Relaxer {
 public:
  Relaxer(SurfaceMesh& surface, const SizingField& sizing)
      : surface_(surface), stars_(surface.points.size()) {
    for (const Vector3d& p : surface.points) sizes_.push_back(sizing.at(p));
    for (const Triangle& t : surface.triangles)
      for (const std::uint32_t v : t) stars_.count(v);
    stars_.allocate();
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
      const Triangle& c = surface.triangles[t];
      for (std::size_t i = 0; i < 3; ++i) stars_.add(c[i], {c[(i + 1) % 3], c[(i + 2) % 3], t});
    }
    for (std::uint32_t v = 0; v < surface.points.size(); ++v)
      if (is_inside_patch(v)) free_.push_back(v);
  }

  void run() {
    for (int round = 0; round < kRelaxRounds; ++round)
      for (const std::uint32_t v : free_) relax(v);
  }

 private:
  /// Its triangles lie between the same labels, each next to another on both sides.
  bool is_inside_patch(std::uint32_t v) {
    const std::span<const Opposite> star = stars_.at(v);
    std::vector<std::uint32_t> leaving, arriving;
    for (const Opposite& t : star) {
      if (surface_.sides[t.triangle] != surface_.sides[star[0].triangle]) return false;
      leaving.push_back(t.p);
      arriving.push_back(t.q);
    }
    std::sort(leaving.begin(), leaving.end());
    std::sort(arriving.begin(), arriving.end());
    return !star.empty() && leaving == arriving &&
           std::adjacent_find(leaving.begin(), leaving.end()) == leaving.end();
  }

  void relax(std::uint32_t v) {
    const Vector3d x = surface_.points[v];
    ring_.clear();
    double thinnest = kThinnestCosine;
    for (const Opposite& t : stars_.at(v)) {
      const double target = sizes_[v] + sizes_[t.p] + sizes_[t.q];
      ring_.push_back({surface_.points[t.p], surface_.points[t.q], target * target});
      thinnest = std::max(thinnest, sharpest_cosine({x, ring_.back().p, ring_.back().q}));
    }
    const TangentialStep to = tangential_relaxation(x, ring_, kShapeWeight);
    for (const RingTriangle& t : ring_) {
      const Vector3d cross = triangle_cross(x, t.p, t.q);
      if (!(cross.dot(to.normal) >= kBentCosine * cross.norm())) return;
    }
    for (const double step : {0.8, 0.4, 0.2})
      if (allows(x, x + step * to.step, thinnest)) {
        surface_.points[v] = x + step * to.step;
        return;
      }
  }

  bool allows(const Vector3d& from, const Vector3d& to, double thinnest) const {
    return std::all_of(ring_.begin(), ring_.end(), [&](const RingTriangle& t) {
      const Vector3d before = triangle_cross(from, t.p, t.q), after = triangle_cross(to, t.p, t.q);
      return before.dot(after) >= kTurnCosine * before.norm() * after.norm() &&
             sharpest_cosine({to, t.p, t.q}) <= thinnest;
    });
  }

  SurfaceMesh& surface_;
  Buckets<Opposite> stars_;
  std::vector<double> sizes_;
  std::vector<std::uint32_t> free_;
  std::vector<RingTriangle> ring_;  ///< of the point under way
};

}  // namespace

void relax_surface(SurfaceMesh& surface, const SizingField& sizing) {
  Relaxer(surface, sizing).run();
}

}  // namespace voxtet::remesh
