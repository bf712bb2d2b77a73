#include "tetra/mesh/tet_quality.h"

#include "geometry/elements/tet_measures.h"

namespace voxtet::tetra {

double quality_of_angle(double degrees) {
  const double x = degrees * (EIGEN_PI / 180);
  double term = x, sine = x;
  for (int k = 1; k < 12; ++k) sine += term *= -x * x / (2 * k * (2 * k + 1));
  return sine * sine;
}

ApexSines::ApexSines(const Point& a, const Point& b, const Point& c, const Point& d)
    : side_{b - a, c - a, d - a} {
  normal_[1] = side_[1].cross(side_[2]);
  normal_[2] = side_[2].cross(side_[0]);
  normal_[3] = side_[0].cross(side_[1]);
  normal_[0] = (side_[2] - side_[0]).cross(side_[1] - side_[0]);
  six_volumes_ = side_[0].dot(normal_[1]);
  for (std::size_t f = 0; f < 4; ++f) area_[f] = normal_[f].squaredNorm();
  for (std::size_t e = 0; e < 6; ++e) {
    const auto i = static_cast<std::size_t>(kEdgesOfTet[e].first),
               j = static_cast<std::size_t>(kEdgesOfTet[e].second);
    const auto k = static_cast<std::size_t>(kEdgesOfTet[5 - e].first),
               l = static_cast<std::size_t>(kEdgesOfTet[5 - e].second);
    const double edge = i == 0 ? side_[j - 1].squaredNorm() : (side_[j - 1] - side_[i - 1]).squaredNorm();
    values_[e] = six_volumes_ * six_volumes_ * edge / (area_[k] * area_[l]) *
                 (normal_[k].dot(normal_[l]) > 0 ? kObtuseFactor : 1);
  }
}

Point ApexSines::gradient(std::size_t edge) const {
  // The logarithm of six_volumes^2 edge^2 / (N N'), term by term; the face opposite to a does not change.
  const auto area_change = [this](std::size_t face) -> Point {
    if (face == 0) return Point::Zero();
    const std::size_t next = face % 3, last = (face + 1) % 3;
    return 2 * (side_[next] - side_[last]).cross(normal_[face]) / area_[face];
  };
  const auto [i, j] = kEdgesOfTet[edge];
  const auto [k, l] = kEdgesOfTet[5 - edge];
  Point change = 2 * normal_[0] / six_volumes_ - area_change(static_cast<std::size_t>(k)) -
                 area_change(static_cast<std::size_t>(l));
  if (i == 0) {
    const Point& side = side_[static_cast<std::size_t>(j) - 1];
    change -= 2 * side / side.squaredNorm();
  }
  return values_[edge] * change;
}

}  // namespace voxtet::tetra
