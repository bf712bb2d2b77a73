// How well shaped a tetrahedron is, by its dihedral angles and without trigonometry.
// The smallest sine: L. A. Freitag and C. Ollivier-Gooch, "Tetrahedral mesh improvement using swapping and
// smoothing", Int. J. Numer. Meth. Engng 40 (1997).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>

namespace voxtet::tetra {

using Point = Eigen::Vector3d;  ///< mm

/// The sine of an obtuse angle is divided by 0.7, its square by 0.49: small angles are worse.
inline constexpr double kObtuseFactor = 1 / 0.49;

/// The square of the smallest of the six sines of the dihedral angles, obtuse ones favoured by kObtuseFactor:
/// 0.889 for the regular tetrahedron, towards 0 when it flattens, 0 when it is not positive.
inline double quality(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Point u = b - a, v = c - a, w = d - a, bc = v - u, bd = w - u, cd = w - v;
  // Normals of the faces opposite to the corners, all inward, twice the area long. That opposite to a is not
  // taken as minus the sum of the others, which would be all rounding where b, c, d are nearly in line.
  const Point ma = bd.cross(bc), mb = v.cross(w), mc = w.cross(u), md = u.cross(v);
  const double six_volumes = u.dot(mb);
  const double na = ma.squaredNorm(), nb = mb.squaredNorm(), nc = mc.squaredNorm(), nd = md.squaredNorm();
  const double areas = na * nb * nc * nd;
  if (!(six_volumes > 0 && areas > 0)) return 0;
  // sin^2 = (6 V)^2 e^2 / (N N') with the faces at the edge; all over one denominator.
  const auto term = [](const Point& edge, double others, double cosine) {
    return edge.squaredNorm() * others * (cosine > 0 ? kObtuseFactor : 1);
  };
  const double apex =
      std::min({term(u, nb, mc.dot(md)), term(v, nc, mb.dot(md)), term(w, nd, mb.dot(mc))}) * na;
  const double base =
      std::min({term(bc, nb * nc, ma.dot(md)), term(bd, nb * nd, ma.dot(mc)), term(cd, nc * nd, ma.dot(mb))});
  return six_volumes * six_volumes * std::min(apex, base) / areas;
}

/// The quality of a tetrahedron whose worst dihedral angle has this size, in (0, 90] degrees. Computed by a
/// series, since the sines of standard libraries differ in their last digit.
double quality_of_angle(double degrees);

/// The six squared sines behind quality(a, b, c, d) as functions of the corner a, for positive tetrahedra.
class ApexSines {
 public:
  ApexSines(const Point& a, const Point& b, const Point& c, const Point& d);
  /// At the edges ab, ac, ad, bc, bd, cd.
  const std::array<double, 6>& values() const { return values_; }
  Point gradient(std::size_t edge) const;

 private:
  std::array<Point, 3> side_;    ///< b - a, c - a, d - a
  std::array<Point, 4> normal_;  ///< of the faces opposite to a, b, c, d: inward, twice the area long
  std::array<double, 4> area_;   ///< squared lengths of the normals
  double six_volumes_;
  std::array<double, 6> values_;
};

}  // namespace voxtet::tetra
