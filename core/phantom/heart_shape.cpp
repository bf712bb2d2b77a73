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
constexpr double kBaseHeight = 22;
const Vector3d kLow(-36, -39, -57), kHigh(60, 43, 29);

// The scar lies on the antero-lateral wall of the LV.
const Eigen::Vector2d kScarDirection(-0.8, 0.6);
constexpr double kScarHeight = -9;
constexpr double kMidWallRadius = 28;
constexpr double kRadians = 3.14159265358979323846 / 180;

/// With lengths along the axis times `factor`.
Ellipsoid stretched(Ellipsoid ellipsoid, double factor) {
  ellipsoid.centre.z() *= factor;
  ellipsoid.semi_axes.z() *= factor;
  return ellipsoid;
}

}  // namespace

HeartShape heart_shape(const PhantomParams& params) {
  const double length = params.length_scale;
  const Vector3d lv_growth = (params.wall_scale - 1) * kLvWall;
  const double rv_growth = params.rv_wall_mm - kRvWall;

  // The septum's right side moves by `moved`, and the right ventricle with it: so much wider that its cavity
  // stays as large. A dilated one moves its free wall out by `deeper` where it is deepest, less in front and
  // behind, and least at the apex.
  const double moved = lv_growth.x();
  const double deeper = (params.rv_dilation - 1) * kRvDepth;
  Ellipsoid rv = stretched(kRvOutside, length);
  rv.centre.x() += moved + deeper / 2;
  rv.semi_axes += Vector3d(deeper / 2, 0.2 * moved + 0.25 * deeper, 0.15 * deeper);
  Ellipsoid infundibulum = stretched(kInfundibulumOutside, length);
  infundibulum.centre += Vector3d(0.7 * moved + 0.5 * deeper, 0.7 * moved + 0.3 * deeper, 0);
  infundibulum.semi_axes += Vector3d(0.15 * deeper, 0.15 * deeper, 0);

  HeartShape shape;
  shape.lv_cavity = stretched({Vector3d::Zero(), kLvCavity}, length);
  shape.lv_outside = shape.lv_cavity;
  shape.lv_outside.semi_axes += kLvWall + lv_growth;
  shape.rv_cavity = rv.shrunk(kRvWall);
  shape.rv_outside = rv.shrunk(-rv_growth);
  shape.infundibulum_cavity = infundibulum.shrunk(kRvWall);
  shape.infundibulum_outside = infundibulum.shrunk(-rv_growth);
  shape.base_height = kBaseHeight * length;

  // The base plane is tilted, so that what grows to the sides grows a little upwards too.
  const auto more = [](double growth) { return std::max(growth, 0.0); };
  const double wider = more(moved) + more(deeper) + more(rv_growth);
  shape.low = kLow - Vector3d(wider, wider, more(kLvCavity.z() * (length - 1)) + wider);
  shape.high = kHigh + Vector3d(wider, wider, more(kBaseHeight * (length - 1)) + 0.15 * wider);

  const auto [cosine, sine] = cos_sin(params.scar_angle_deg * kRadians);
  shape.scar_direction = {cosine * kScarDirection.x() - sine * kScarDirection.y(),
                          sine * kScarDirection.x() + cosine * kScarDirection.y()};
  shape.scar_height = kScarHeight * length + params.scar_height_mm;
  shape.scar_outline = {Vector3d::Zero(), {kArcShare * params.scar_arc_mm / 2, params.scar_length_mm / 2, 1}};
  shape.mid_wall_radius = kMidWallRadius + moved / 2;
  return shape;
}

}  // namespace voxtet
