#include "remesh/delaunay/fit_surface.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "base/buckets.h"
#include "base/parallel.h"
#include "geometry/elements/surface_measures.h"
#include "geometry/elements/triangle_measures.h"
#include "geometry/search/closest_point.h"
#include "remesh/delaunay/find_missed.h"
#include "remesh/motion/volume_offsets.h"

namespace voxtet::remesh {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Of a point's own system: keeps shifts along the surface small where the normals hardly differ.
constexpr double kTangentialWeight = 0.05;
constexpr double kLeastDihedralCosine = 0.6427876096865394;  // cos 50 deg
constexpr int kFitRounds = 12;
constexpr int kSteps = 3;
constexpr double kWidening = 0.15;  ///< of a thin triangle's shortest edge, in one round
constexpr int kWideningRounds = 10;

/// A triangle at one of its edges.
struct Wing {
  std::uint32_t a, b;  ///< the edge, a < b
  std::uint32_t tip;
  std::uint32_t triangle;

  bool same_edge(const Wing& other) const { return a == other.a && b == other.b; }
};

/// All wings, those of an edge one after the other.
std::vector<Wing> wings_of(const SurfaceMesh& surface) {
  Buckets<Wing> by_lower(surface.points.size());
  const auto for_edges = [&](const auto& visit) {
    for (std::uint32_t triangle = 0; triangle < surface.triangles.size(); ++triangle) {
      const Triangle& t = surface.triangles[triangle];
      for (std::size_t i = 0; i < 3; ++i)
        visit(Wing{std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3]), t[(i + 2) % 3], triangle});
    }
  };
  for_edges([&](const Wing& wing) { by_lower.count(wing.a); });
  by_lower.allocate();
  for_edges([&](const Wing& wing) { by_lower.add(wing.a, wing); });
  std::vector<Wing> wings;
  wings.reserve(3 * surface.triangles.size());
  for (std::size_t a = 0; a < by_lower.size(); ++a) {
    const std::span<Wing> own = by_lower.at(a);
    std::sort(own.begin(), own.end(),
              [](const Wing& x, const Wing& y) { return std::tie(x.b, x.tip) < std::tie(y.b, y.tip); });
    wings.insert(wings.end(), own.begin(), own.end());
  }
  return wings;
}

/// By triangle, the mean distance of a facet whose corners lie on the interface: the rule of the edge
/// midpoints is exact for quadratics. Edges between facets of the same two labels are looked at once.
std::vector<double> mean_distances(const SurfaceMesh& surface, const std::vector<Wing>& wings,
                                   const LabelField& field, int threads) {
  // A wing stands for those after it at its edge that have its sides, unless one before it does.
  std::vector<double> thirds(wings.size(), 0);
  const auto has_sides_of = [&](std::size_t w, std::size_t v) {
    return surface.sides[wings[v].triangle] == surface.sides[wings[w].triangle];
  };
  const auto stands = [&](std::size_t w) {
    for (std::size_t v = w; v > 0 && wings[v - 1].same_edge(wings[w]); --v)
      if (has_sides_of(w, v - 1)) return false;
    return true;
  };
  parallel_for(threads, wings.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t w = first; w < last; ++w) {
      if (!stands(w)) continue;
      const Sides& sides = surface.sides[wings[w].triangle];
      const Vector3d middle = 0.5 * (surface.points[wings[w].a] + surface.points[wings[w].b]);
      thirds[w] = field.distance(middle, sides[0], sides[1]).value_or(0) / 3;
    }
  });
  std::vector<double> means(surface.triangles.size(), 0);
  for (std::size_t w = 0; w < wings.size(); ++w)
    if (stands(w))
      for (std::size_t v = w; v < wings.size() && wings[v].same_edge(wings[w]); ++v)
        if (has_sides_of(w, v)) means[wings[v].triangle] += thirds[w];
  return means;
}

/// Shifts that are halved where they would make the surface worse, in the later rounds down to nothing.
class Shifts {
 public:
  /// `far`: points from whose closest triangles the surface is to go no farther away than `farthest_mm`.
  Shifts(const SurfaceMesh& surface, std::vector<FarPoint> far, double farthest_mm, const RunContext& ctx)
      : by_point(surface.points.size(), Vector3d::Zero()),
        surface_(surface),
        wings_(wings_of(surface)),
        far_(std::move(far)),
        farthest_mm_(farthest_mm),
        ctx_(ctx) {}

  std::vector<Vector3d> by_point;

  const std::vector<Wing>& wings() const { return wings_; }

  /// False when cancelled.
  bool restrain() {
    halved_in_.assign(by_point.size(), 0);
    for (round_ = 0; round_ < kFitRounds; ++round_) {
      if (ctx_.cancelled()) return false;
      const bool thin = halve_where_thin(), sharp = halve_where_sharp(), far = halve_where_far();
      if (!thin && !sharp && !far) break;
    }
    return true;
  }

  /// Moves the points of what the shifts were made for; none are left.
  void apply(SurfaceMesh& surface) {
    for (std::size_t p = 0; p < by_point.size(); ++p) surface.points[p] += by_point[p];
    by_point.assign(by_point.size(), Vector3d::Zero());
  }

 private:
  /// Whether none of some points moves, or what they are part of was looked at as it is.
  template <std::size_t n>
  bool rest(const std::array<std::uint32_t, n>& points) const {
    return std::all_of(points.begin(), points.end(),
                       [&](std::uint32_t p) { return by_point[p].isZero(0); }) ||
           std::all_of(points.begin(), points.end(),
                       [&](std::uint32_t p) { return halved_in_[p] + 1 < round_; });
  }

  template <std::size_t n>
  void halve(const std::array<std::uint32_t, n>& points) {
    for (const std::uint32_t p : points) {
      by_point[p] *= round_ < kFitRounds / 2 ? 0.5 : 0;
      halved_in_[p] = round_;
    }
  }

  /// Whether a measure, a function of the share of the shifts, grows to more than it may.
  template <class Measure>
  static bool worsens(const Measure& measure, double limit) {
    const double after = measure(1.0);
    return after > limit && after > measure(0.0);
  }

  Vector3d at(std::uint32_t p, double share) const { return surface_.points[p] + share * by_point[p]; }

  bool halve_where_thin() {
    bool changed = false;
    for (const Triangle& t : surface_.triangles) {
      if (rest(t)) continue;
      const auto cosine = [&](double share) {
        return sharpest_cosine({at(t[0], share), at(t[1], share), at(t[2], share)});
      };
      if (!worsens(cosine, kThinnestCosine)) continue;
      changed = true;
      halve(t);
    }
    return changed;
  }

  bool halve_where_sharp() {
    bool changed = false;
    for (std::size_t w = 0; w < wings_.size(); ++w)
      for (std::size_t v = w + 1; v < wings_.size() && wings_[v].same_edge(wings_[w]); ++v) {
        const Wing &x = wings_[w], &y = wings_[v];
        const std::array points{x.a, x.b, x.tip, y.tip};
        if (rest(points)) continue;
        const auto cosine = [&](double share) {
          const Vector3d a = at(x.a, share), axis = at(x.b, share) - a;
          const Vector3d m = axis.cross(at(x.tip, share) - a), n = axis.cross(at(y.tip, share) - a);
          return m.dot(n) / std::sqrt(m.squaredNorm() * n.squaredNorm());
        };
        if (!worsens(cosine, kLeastDihedralCosine)) continue;
        changed = true;
        halve(points);
      }
    return changed;
  }

  bool halve_where_far() {
    bool changed = false;
    for (const FarPoint& far : far_) {
      const Triangle& t = surface_.triangles[far.triangle];
      if (rest(t)) continue;
      const auto distance = [&](double share) {
        const Vector3d on = closest_on_triangle(far.point, at(t[0], share), at(t[1], share), at(t[2], share));
        return (on - far.point).norm();
      };
      if (!worsens(distance, farthest_mm_)) continue;
      changed = true;
      halve(t);
    }
    return changed;
  }

  int round_ = 0;
  std::vector<int> halved_in_;  ///< by point, the last round
  const SurfaceMesh& surface_;
  const std::vector<Wing> wings_;
  const std::vector<FarPoint> far_;
  const double farthest_mm_;
  const RunContext& ctx_;
};

/// By triangle, the offset along its normal that its pair of labels needs for their volumes.
std::vector<double> offsets_of(const SurfaceMesh& surface, const std::vector<double>& target_mm3,
                               double most) {
  std::vector<Sides> pairs = surface.sides;
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::vector<std::size_t> pair_of;
  std::vector<double> areas(pairs.size(), 0);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto [a, b, c] = surface.triangles[t];
    pair_of.push_back(static_cast<std::size_t>(
        std::lower_bound(pairs.begin(), pairs.end(), surface.sides[t]) - pairs.begin()));
    areas[pair_of.back()] += triangle_area_mm2(surface.points[a], surface.points[b], surface.points[c]);
  }
  std::vector<double> lacking = target_mm3;
  const std::vector<double> now = enclosed_volumes_mm3(surface);
  for (std::size_t l = 0; l < std::min(now.size(), lacking.size()); ++l) lacking[l] -= now[l];
  const std::vector<double> by_pair = volume_offsets(pairs, areas, lacking, most);
  std::vector<double> offsets;
  offsets.reserve(pair_of.size());
  for (const std::size_t pair : pair_of) offsets.push_back(by_pair[pair]);
  return offsets;
}

/// One step of all points. `offsets`: by triangle, what its mean distance is to be besides 0; may be empty.
/// False when cancelled.
bool fit_once(SurfaceMesh& surface, const LabelField& field, const std::vector<double>& offsets, double most,
              Shifts& shifts, int threads) {
  std::vector<Matrix3d> normal(surface.points.size(), Matrix3d::Zero());
  std::vector<Vector3d> right(surface.points.size(), Vector3d::Zero());
  const std::vector<double> distances = mean_distances(surface, shifts.wings(), field, threads);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Triangle& corners = surface.triangles[t];
    const Vector3d& p = surface.points[corners[0]];
    const Vector3d across = (surface.points[corners[1]] - p).cross(surface.points[corners[2]] - p);
    const double area = across.norm();
    if (!(area > 0)) continue;
    const Vector3d n = across / area;
    const double distance = distances[t] + (offsets.empty() ? 0 : offsets[t]);
    for (const std::uint32_t corner : corners) {
      normal[corner] += area * n * n.transpose();
      right[corner] += area * distance * n;
    }
  }
  for (std::size_t p = 0; p < surface.points.size(); ++p) {
    const double weight = kTangentialWeight * normal[p].trace();
    if (!(weight > 0)) continue;
    Vector3d& shift = shifts.by_point[p];
    shift = (normal[p] + weight * Matrix3d::Identity()).llt().solve(right[p]);
    const double length = shift.norm();
    if (length > most) shift *= most / length;
  }
  if (!shifts.restrain()) return false;
  shifts.apply(surface);
  return true;
}

/// Spreads the thin triangles that mended cells leave: the ends of their shortest edges go apart, as far as
/// the triangles around them allow. False when cancelled.
bool widen_thin(SurfaceMesh& surface, Shifts& shifts) {
  for (int round = 0; round < kWideningRounds; ++round) {
    bool any = false;
    for (const Triangle& t : surface.triangles) {
      const std::array<Vector3d, 3> p{surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]};
      if (!(sharpest_cosine(p) > kThinnestCosine)) continue;
      any = true;
      const auto edge = [&](std::size_t i) -> Vector3d { return p[(i + 2) % 3] - p[(i + 1) % 3]; };
      std::size_t apex = 0;
      for (std::size_t i = 1; i < 3; ++i)
        if (edge(i).squaredNorm() < edge(apex).squaredNorm()) apex = i;
      const std::size_t b = (apex + 1) % 3, c = (apex + 2) % 3;
      shifts.by_point[t[b]] -= kWidening * edge(apex);
      shifts.by_point[t[c]] += kWidening * edge(apex);
      shifts.by_point[t[apex]] += 0.5 * kWidening * (0.5 * (p[b] + p[c]) - p[apex]);
    }
    if (!any) return true;
    if (!shifts.restrain()) return false;
    shifts.apply(surface);
  }
  return true;
}

}  // namespace

bool fit_surface(SurfaceMesh& surface, const LabelField& field, const SurfaceMesh& reference,
                 const std::vector<double>& volumes_mm3, const RunContext& ctx) {
  const double unit = (field.layers().empty() ? 1 : kLayerFreedom) * field.grid().smallest_spacing_mm();
  const double most = kMostShiftVoxels * unit, farthest = kFarthestVoxels * unit;
  Shifts shifts(surface, far_points(reference, surface, field.layers(), farthest - 2 * most), farthest, ctx);
  std::vector<double> offsets;
  if (!fit_once(surface, field, offsets, most, shifts, ctx.threads)) return false;
  offsets.assign(surface.triangles.size(), 0);
  for (int step = 1; step < kSteps; ++step) {
    const std::vector<double> more = offsets_of(surface, volumes_mm3, most);
    for (std::size_t t = 0; t < offsets.size(); ++t)
      offsets[t] = std::clamp(offsets[t] + more[t], -most, most);
    if (!fit_once(surface, field, offsets, most / (1 << step), shifts, ctx.threads)) return false;
  }
  return widen_thin(surface, shifts);
}

}  // namespace voxtet::remesh
