#include "phantom/heart_shape.h"

#include "base/portable_trig.h"

namespace voxtet {
namespace {

using Eigen::Vector3d;

// The heart at the default parameters. What others change is added, or is a factor: nothing here.
const Vector3d kLvCavity(24, 24, 46);
const Vector3d kLvWall(9.5, 9.5, 6);
const Ellipsoid kRvOutside{{16, 1, 6}, {41, 35.5, 47}};
const Ellipsoid kInfundibulumOutside{{21, 23, 21}, {22, 17, 24}};
constexpr double kRvWall = 3.8;
constexpr double kRvDepth = 19.7;  // of the RV cavity, from the septum to the free wall where it is deepest
constexpr double kRvDepthForWidth = 27.5;  // that makes up for width in the RV cavity's volume
constexpr double kBaseHeight = 22;
const Vector3d kLow(-36, -39, -57), kHigh(60, 43, 29);

// The scar lies on the antero-lateral wall of the LV.
const Eigen::Vector2d kScarDirection(-0.8, 0.6);
constexpr double kScarHeight = -9;
constexpr double kMidWallRadius = 28;
constexpr double kRadians = 3.14159265358979323846 / 180;

/// With x, y and z times `factors`.
Ellipsoid stretched(const Ellipsoid& ellipsoid, const Vector3d& factors) {
  return {ellipsoid.centre.cwiseProduct(factors), ellipsoid.semi_axes.cwiseProduct(factors)};
}

/// Longer by `towards_x` at the end that lies towards +x, and by `y` and `z` at both ends of the other axes.
Ellipsoid grown(Ellipsoid ellipsoid, double towards_x, double y, double z) {
  ellipsoid.centre.x() += towards_x / 2;
  ellipsoid.semi_axes += Vector3d(towards_x / 2, y, z);
  return ellipsoid;
}

}  // namespace

HeartShape heart_shape(const PhantomParams& params) {
  const double length = params.length_scale;
  const Vector3d lv_growth = (params.wall_scale - 1) * kLvWall;
  HeartShape shape;
  shape.lv_cavity = stretched({Vector3d::Zero(), kLvCavity}, {1, 1, length});
  shape.lv_outside = shape.lv_cavity;
  shape.lv_outside.semi_axes += kLvWall + lv_growth;

  // The right ventricle is wider by the factor by which the left one is that it sits on, or else it would
  // stand out on the left one's other side. Its free wall moves by `deeper`: by what it is dilated, and by
  // what keeps its cavity as large as it was; in front and behind it moves less, and least at the apex.
  const double wider = 1 + lv_growth.x() / (kLvCavity.x() + kLvWall.x());
  const double deeper = (params.rv_dilation - 1) * kRvDepth + (1 - wider) * kRvDepthForWidth;
  const Ellipsoid rv =
      grown(stretched(kRvOutside, {wider, wider, length}), deeper, 0.25 * deeper, 0.15 * deeper);
  Ellipsoid infundibulum = stretched(kInfundibulumOutside, {wider, wider, length});
  infundibulum.centre += Vector3d(0.5 * deeper, 0.3 * deeper, 0);
  infundibulum.semi_axes += Vector3d(0.15 * deeper, 0.15 * deeper, 0);
  shape.rv_cavity = rv.shrunk(kRvWall);
  shape.infundibulum_cavity = infundibulum.shrunk(kRvWall);

  const double rv_growth = params.rv_wall_mm - kRvWall;
  shape.rv_outside = grown(rv, rv_growth, rv_growth, rv_growth);
  shape.infundibulum_outside = infundibulum.shrunk(-rv_growth);
  shape.base_height = kBaseHeight * length;

  // The base plane is tilted: what grows to the sides there grows a little upwards too.
  const auto more = [](double growth) { return std::max(growth, 0.0); };
  const double sideways = more(lv_growth.x()) + more(deeper) + more(rv_growth);
  shape.low = kLow - Vector3d(sideways, sideways, sideways + more(kLvCavity.z() * (length - 1)));
  shape.high = kHigh + Vector3d(sideways, sideways, 0.15 * sideways + more(kBaseHeight * (length - 1)));

  const auto [cosine, sine] = cos_sin(params.scar_angle_deg * kRadians);
  shape.scar_direction = {cosine * kScarDirection.x() - sine * kScarDirection.y(),
                          sine * kScarDirection.x() + cosine * kScarDirection.y()};
  shape.scar_height = kScarHeight * length + params.scar_height_mm;
  shape.scar_outline = {Vector3d::Zero(), {kArcShare * params.scar_arc_mm / 2, params.scar_length_mm / 2, 1}};
  shape.mid_wall_radius = kMidWallRadius + lv_growth.x() / 2;
  return shape;
}

}  // namespace voxtet
