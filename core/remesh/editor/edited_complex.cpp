#include "remesh/editor/edited_complex.h"

#include <cmath>
#include <utility>

#include "geometry/elements/surface_measures.h"
#include "geometry/elements/triangle_measures.h"
#include "geometry/search/closest_point.h"

namespace voxtet::remesh {
namespace {

constexpr double kCoveredShare = 0.75;
constexpr std::uint32_t kEveryCorner = kNone - 1;
constexpr double kCloserShare = 0.3;  ///< of the lattice's spacing, where a closer look is needed

/// Of a point of the triangle.
Eigen::Vector3d barycentric(const Eigen::Vector3d& on, const Corners& p) {
  const Eigen::Vector3d normal = triangle_cross(p[0], p[1], p[2]);
  Eigen::Vector3d weights;
  for (int i = 0; i < 3; ++i) weights[i] = triangle_cross(on, p[(i + 1) % 3], p[(i + 2) % 3]).dot(normal);
  return weights / normal.squaredNorm();
}

}  // namespace

EditedComplex::EditedComplex(ComplexMesh mesh, const ComplexMesh& reference,
                             const Correspondence& correspondence, const SizingField& sizing)
    : mesh_(std::move(mesh)),
      reference_(reference),
      samples_(mesh_, reference_, correspondence),
      sizing_(sizing),
      hints_(correspondence.hints) {
  sizes_.reserve(mesh_.vertex_count());
  normals_.reserve(mesh_.slot_count());
  balls_.reserve(mesh_.slot_count());
  for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) sizes_.push_back(sizing.at(mesh_.point(v)));
  for (std::uint32_t t = 0; t < mesh_.slot_count(); ++t) {
    const Corners p = mesh_.corners(mesh_.triangle(t));
    const Eigen::Vector3d cross = triangle_cross(p[0], p[1], p[2]);
    normals_.push_back(cross / std::max(cross.norm(), 1e-300));
    balls_.emplace_back(p);
  }
}

double EditedComplex::distance2_of(const Facet& facet, const Corners& p, std::uint32_t moved,
                                   double most2) const {
  return farthest_point(facet, p, moved, limits.lattice_mm, most2, nearest_hint(facet, p), most2).distance2;
}

/// Of the corners' hints that are on a sheet of the facet's labels.
std::uint32_t EditedComplex::nearest_hint(const Facet& facet, const Corners& p) const {
  std::uint32_t nearest = kNone;
  double least = kNowhere;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t hint = hints_[facet.corners[i]];
    if (hint == kNone || !reference_.beside(hint, facet.pair)) continue;
    const double distance2 = (reference_.point(hint) - p[i]).squaredNorm();
    if (distance2 < least) {
      least = distance2;
      nearest = hint;
    }
  }
  return nearest;
}

/// Of the facet's lattice points; the first one above `content2`. Its corners were looked at when they came
/// to their places, and each edge inside the edit is left to one of its two facets.
Deviation EditedComplex::farthest_point(const Facet& facet, const Corners& p, std::uint32_t moved,
                                        double lattice_mm, double content2, std::uint32_t hint,
                                        double enough2, std::span<const std::uint32_t> more_hints) const {
  const int n = static_cast<int>(std::ceil(longest_edge_mm(p) / lattice_mm));
  const double far2 = content2 < kNowhere ? content2 : limits.reach_mm * limits.reach_mm;
  Deviation worst;
  if (hint == kNone) {
    worst.distance2 = kNowhere;
    return worst;
  }
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n - i; ++j) {
      const std::array<int, 3> w{n - i - j, j, i};
      const int zeros = (w[0] == 0) + (w[1] == 0) + (w[2] == 0);
      if (zeros == 2) {
        const std::uint32_t corner = facet.corners[w[0] ? 0 : w[1] ? 1 : 2];
        if (corner != moved && moved != kEveryCorner) continue;
      } else if (zeros == 1) {
        const int from = w[0] == 0 ? 1 : w[1] == 0 ? 2 : 0;
        const std::uint32_t u = facet.corners[from], w2 = facet.corners[(from + 1) % 3];
        if (u > w2 && !on_curves(u, w2)) continue;
      }
      const Eigen::Vector3d at = (w[0] * p[0] + w[1] * p[1] + w[2] * p[2]) / n;
      Eigen::Vector3d toward = reference_.walk(at, facet.pair, hint, enough2) - at;
      double distance2 = toward.squaredNorm();
      const auto walk_from = [&](std::uint32_t from) {
        if (distance2 <= far2 || from == kNone || !reference_.beside(from, facet.pair)) return;
        const Eigen::Vector3d other = reference_.walk(at, facet.pair, from) - at;
        if (other.squaredNorm() >= distance2) return;
        toward = other;
        distance2 = other.squaredNorm();
        hint = from;
      };
      for (const std::uint32_t v : facet.corners) walk_from(hints_[v]);
      for (const std::uint32_t s : more_hints) walk_from(s);
      if (distance2 <= worst.distance2) continue;
      worst = {distance2, toward, Eigen::Vector3d(w[0], w[1], w[2]) / n};
      if (distance2 > content2) return worst;
    }
  return worst;
}

std::vector<std::uint32_t> EditedComplex::samples_of(std::uint32_t t) const {
  std::vector<std::uint32_t> samples;
  samples_.for_samples(t, [&](std::uint32_t s) { samples.push_back(s); });
  return samples;
}

void EditedComplex::make_room_for_deviations() const {
  if (deviations_lattice_mm_ != limits.lattice_mm) deviations_.clear();
  deviations_lattice_mm_ = limits.lattice_mm;
  deviations_.resize(mesh_.slot_count(), kUnknown);
}

/// Walks may end on the way: what seems to be beyond the envelope is looked at from more places.
Deviation EditedComplex::find_deviation(std::uint32_t t, const Corners& p) const {
  const Facet facet{mesh_.triangle(t), mesh_.pair(t)};
  // No point of the facet is farther than this from a point of the lattice.
  const double between_mm = limits.lattice_mm / std::sqrt(3.0);
  const double sure_mm = std::max(0.0, limits.sure_mm - between_mm);
  // Nothing depends on how much nearer than this a point is.
  const double enough_mm = limits.sure_mm > 0 ? sure_mm : limits.reach_mm;
  const double enough2 = std::min(reference_.near2(), enough_mm * enough_mm);
  const auto look = [&](double lattice_mm) {
    return farthest_point(facet, p, kEveryCorner, lattice_mm, kNowhere, nearest_hint(facet, p), enough2,
                          samples_of(t));
  };
  const Deviation deviation = look(limits.lattice_mm);
  const bool sure = !(limits.sure_mm > 0 && deviation.distance2 > sure_mm * sure_mm);
  return sure ? deviation : look(kCloserShare * limits.lattice_mm);
}

Deviation EditedComplex::farthest(std::uint32_t t) const {
  const Corners p = mesh_.corners(mesh_.triangle(t));
  if (known_deviation(t) == nullptr) {
    if (deviations_lattice_mm_ != limits.lattice_mm || t >= deviations_.size()) make_room_for_deviations();
    deviations_[t] = find_deviation(t, p);
  }
  Deviation worst = deviations_[t];
  samples_.for_samples(t, [&](std::uint32_t s) {
    const Eigen::Vector3d& at = reference_.point(s);
    const Eigen::Vector3d on = closest_on_triangle(at, p[0], p[1], p[2]);
    const double distance2 = (at - on).squaredNorm();
    if (distance2 > worst.distance2) worst = {distance2, at - on, barycentric(on, p)};
  });
  const Triangle& corners = mesh_.triangle(t);
  for (std::size_t i = 0; i < 3; ++i)
    if (mesh_.is_curve(corners[i], corners[(i + 1) % 3]))
      samples_.for_curve_samples(corners[i], corners[(i + 1) % 3],
                                 [&](std::uint32_t s) { look_from(reference_.point(s), t, p, worst); });
  look_between_samples(t, p, worst);
  return worst;
}

/// Whether other facets of its labels at its corners are much turned against it.
bool EditedComplex::is_folded(std::uint32_t t) const {
  constexpr double kFoldedCosine = 0.9;
  for (const std::uint32_t v : mesh_.triangle(t))
    for (const std::uint32_t other : mesh_.star(v))
      if (mesh_.pair(other) == mesh_.pair(t) && normals_[other].dot(normals_[t]) < kFoldedCosine) return true;
  return false;
}

/// Where the surface is folded, the reference may be farther from it between two samples than at both: on
/// edges from samples of `t` to others', as far as their middle.
void EditedComplex::look_between_samples(std::uint32_t t, const Corners& p, Deviation& worst) const {
  if (!is_folded(t)) return;
  const std::vector<std::uint32_t> own = samples_of(t);
  for (const std::uint32_t s : own)
    reference_.for_neighbours(s, mesh_.pair(t), [&](std::uint32_t r) {
      if (std::find(own.begin(), own.end(), r) != own.end()) return;
      const Eigen::Vector3d &from = reference_.point(s), &to = reference_.point(r);
      for (const double share : {0.25, 0.5}) look_from(from + share * (to - from), t, p, worst);
    });
}

/// From a point of the reference at `t` and the facets of its labels around it.
void EditedComplex::look_from(const Eigen::Vector3d& at, std::uint32_t t, const Corners& p,
                              Deviation& worst) const {
  const Eigen::Vector3d on = closest_on_triangle(at, p[0], p[1], p[2]);
  double distance2 = (at - on).squaredNorm();
  for (const std::uint32_t v : mesh_.triangle(t))
    for (const std::uint32_t other : mesh_.star(v)) {
      if (distance2 <= worst.distance2) return;
      if (mesh_.pair(other) != mesh_.pair(t)) continue;
      const Corners q = mesh_.corners(mesh_.triangle(other));
      distance2 = std::min(distance2, (closest_on_triangle(at, q[0], q[1], q[2]) - at).squaredNorm());
    }
  if (distance2 > worst.distance2) worst = {distance2, at - on, barycentric(on, p)};
}

bool EditedComplex::well_sampled(std::uint32_t t, double reach_mm) const {
  for (const std::uint32_t v : mesh_.triangle(t))
    if (mesh_.stratum(v) != Stratum::kSurface) return false;
  if (is_folded(t)) return false;
  const Corners p = mesh_.corners(mesh_.triangle(t));
  double covered = 0, farthest2 = 0;
  samples_.for_samples(t, [&](std::uint32_t s) {
    const Eigen::Vector3d& at = reference_.point(s);
    farthest2 = std::max(farthest2, (closest_on_triangle(at, p[0], p[1], p[2]) - at).squaredNorm());
    covered += reference_.area(s);
  });
  return farthest2 <= reach_mm * reach_mm &&
         covered >= kCoveredShare * 0.5 * triangle_cross(p[0], p[1], p[2]).norm();
}

}  // namespace voxtet::remesh
