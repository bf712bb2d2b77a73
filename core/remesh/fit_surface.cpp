#include "remesh/fit_surface.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace voxtet::remesh {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Of a point's own system: keeps shifts along the surface small where the normals hardly differ.
constexpr double kTangentialWeight = 0.05;
constexpr double kLeastPlanarCosine = 0.8724960070727971;  // cos 29.25 deg
constexpr int kThinRounds = 12;

/// Mean distance of a facet whose corners lie on the interface: the rule of the edge midpoints is exact for
/// quadratics.
double mean_distance(const SurfaceMesh& surface, std::size_t t, const LabelField& field) {
  const auto [a, b, c] = surface.triangles[t];
  const Vector3d &p = surface.points[a], &q = surface.points[b], &r = surface.points[c];
  double sum = 0;
  for (const Vector3d& middle : {Vector3d(0.5 * (p + q)), Vector3d(0.5 * (q + r)), Vector3d(0.5 * (r + p))})
    sum += field.distance(middle, surface.sides[t][0], surface.sides[t][1]).value_or(0);
  return sum / 3;
}

/// Largest cosine of the angles of a triangle.
double sharpest_cosine(const Vector3d& p, const Vector3d& q, const Vector3d& r) {
  const Vector3d u = q - p, v = r - q, w = p - r;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), ww = w.squaredNorm();
  return std::max(
      {-u.dot(w) / std::sqrt(uu * ww), -u.dot(v) / std::sqrt(uu * vv), -v.dot(w) / std::sqrt(vv * ww)});
}

/// Halves the shifts of a triangle that would make it thinner than before and than kLeastPlanar, in the last
/// round down to nothing.
void halve_where_thin(const SurfaceMesh& surface, std::vector<Vector3d>& shifts) {
  const auto cosine = [&](const Triangle& t, double scale) {
    const auto at = [&](std::uint32_t p) { return Vector3d(surface.points[p] + scale * shifts[p]); };
    return sharpest_cosine(at(t[0]), at(t[1]), at(t[2]));
  };
  for (int round = 0; round < kThinRounds; ++round) {
    bool changed = false;
    for (const Triangle& t : surface.triangles) {
      const double after = cosine(t, 1);
      if (after <= kLeastPlanarCosine || after <= cosine(t, 0)) continue;
      changed = true;
      for (const std::uint32_t p : t) shifts[p] *= round < kThinRounds / 2 ? 0.5 : 0.0;
    }
    if (!changed) return;
  }
}

}  // namespace

void fit_surface(SurfaceMesh& surface, const LabelField& field) {
  std::vector<Matrix3d> normal(surface.points.size(), Matrix3d::Zero());
  std::vector<Vector3d> right(surface.points.size(), Vector3d::Zero());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Triangle& corners = surface.triangles[t];
    const Vector3d& p = surface.points[corners[0]];
    const Vector3d across = (surface.points[corners[1]] - p).cross(surface.points[corners[2]] - p);
    const double area = across.norm();
    if (!(area > 0)) continue;
    const Vector3d n = across / area;
    const double distance = mean_distance(surface, t, field);
    for (const std::uint32_t corner : corners) {
      normal[corner] += area * n * n.transpose();
      right[corner] += area * distance * n;
    }
  }
  const double most = kMostShiftVoxels * field.smallest_spacing_mm();
  std::vector<Vector3d> shifts(surface.points.size(), Vector3d::Zero());
  for (std::size_t p = 0; p < surface.points.size(); ++p) {
    const double weight = kTangentialWeight * normal[p].trace();
    if (!(weight > 0)) continue;
    shifts[p] = (normal[p] + weight * Matrix3d::Identity()).llt().solve(right[p]);
    const double length = shifts[p].norm();
    if (length > most) shifts[p] *= most / length;
  }
  halve_where_thin(surface, shifts);
  for (std::size_t p = 0; p < surface.points.size(); ++p) surface.points[p] += shifts[p];
}

}  // namespace voxtet::remesh
