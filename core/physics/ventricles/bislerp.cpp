#include "physics/ventricles/bislerp.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "base/portable_trig.h"

namespace voxtet {

Eigen::Matrix3d bislerp(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, double t) {
  const Eigen::Quaterniond from(a), to(b);
  // The half turns about the columns are products with 1, i, j and k from the right.
  const std::array<Eigen::Quaterniond, 4> alike{from, from * Eigen::Quaterniond(0, 1, 0, 0),
                                                from * Eigen::Quaterniond(0, 0, 1, 0),
                                                from * Eigen::Quaterniond(0, 0, 0, 1)};
  Eigen::Vector4d nearest = alike[0].coeffs();
  for (const Eigen::Quaterniond& q : alike)
    if (std::abs(q.coeffs().dot(to.coeffs())) > std::abs(nearest.dot(to.coeffs()))) nearest = q.coeffs();
  if (nearest.dot(to.coeffs()) < 0) nearest = -nearest;

  // On the circle through both, at the angle t theta from the first.
  const Eigen::Vector4d chord = to.coeffs() - nearest, sum = to.coeffs() + nearest;
  const double theta = 2 * arc_tangent(chord.norm() / sum.norm());
  Eigen::Vector4d across = to.coeffs() - nearest.dot(to.coeffs()) * nearest;
  if (across.norm() == 0) return b;
  across.normalize();
  const auto [cosine, sine] = cos_sin(t * theta);
  return Eigen::Quaterniond(Eigen::Vector4d(cosine * nearest + sine * across))
      .normalized()
      .toRotationMatrix();
}

}  // namespace voxtet
