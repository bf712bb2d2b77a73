#include "remesh/motion/tangential_relaxation.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "geometry/elements/surface_measures.h"

namespace voxtet::remesh {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kHalfSqrt3 = 0.8660254037844386;

/// To the least squares of the differences between the triangles' areas and their targets.
Vector3d step_to_areas(const Vector3d& x, std::span<const RingTriangle> ring, const Vector3d& normal,
                       double area) {
  double targets = 0;
  for (const RingTriangle& t : ring) targets += t.target_area;
  Matrix3d system = Matrix3d::Zero();
  Vector3d excess = Vector3d::Zero();
  for (const RingTriangle& t : ring) {
    const Vector3d growth = 0.5 * normal.cross(t.q - t.p);
    system += growth * growth.transpose();
    excess += growth * (area * t.target_area / targets - 0.5 * triangle_cross(x, t.p, t.q).dot(normal));
  }
  system += system.trace() * normal * normal.transpose();
  return system.inverse() * excess;
}

}  // namespace

TangentialStep tangential_relaxation(const Vector3d& x, std::span<const RingTriangle> ring,
                                     double shape_weight) {
  Vector3d sum = Vector3d::Zero(), by_shape = sum;
  double needs = 0;
  for (const RingTriangle& t : ring) {
    const Vector3d cross = triangle_cross(x, t.p, t.q);
    sum += cross;
    by_shape += t.need * (0.5 * (t.p + t.q) + kHalfSqrt3 * cross.normalized().cross(t.q - t.p));
    needs += t.need;
  }
  const double twice_area = sum.norm();
  const Vector3d normal = sum / twice_area;
  Vector3d step = shape_weight * (by_shape / needs - x);
  if (shape_weight < 1) step += (1 - shape_weight) * step_to_areas(x, ring, normal, 0.5 * twice_area);
  return {normal, step - step.dot(normal) * normal};
}

}  // namespace voxtet::remesh
