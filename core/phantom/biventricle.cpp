// The heart, in millimetres of an adult at end-diastole (scale 1). The long axis is z with the base up; the
// right ventricle lies towards +x, the anterior wall towards +y. By default:
//
//      base plane (slightly tilted)
//   ------------------------------     LV: truncated ellipsoid, endocardium 24 x 24 x 46, wall 9.5, at the
//   |LV wall| LV pool |septum| RV )        apex 6
//    \       \       /      / RV /      RV: ellipsoid beside it with a wall of 3.8, minus the LV; an
//     \       \_____/      /____/           infundibulum bulges at its anterior base; ends above the LV apex
//      \____________/                  Where the walls meet, outer and inner surfaces are rounded by smooth
//                                      minima, so that no label ends in a knife edge.
#include "phantom/heart_shape.h"
#include "phantom/value_noise.h"

namespace voxtet {
namespace {

constexpr double kOuterFillet = 9;    // epicardial groove where the walls meet
constexpr double kCavityFillet = 6;   // corner of the RV cavity at the septum
constexpr double kInflowFillet = 10;  // RV body to infundibulum
constexpr double kRimFillet =
    3;  // outer rim of the base; less than the thinnest wall, so that pools stay enclosed
const Eigen::Vector3d kBaseNormal(0.06, 0.08, std::sqrt(1 - 0.06 * 0.06 - 0.08 * 0.08));
const Eigen::Vector3d kOrigin(12, 2, -14);       // comes to lie at (0, 0, 0); the default heart's middle
const Eigen::Vector2d kIsthmusNormal(0.8, 0.6);  // across the channel, in (arc, height)
constexpr double kWobble = 2;                    // of the scar's outline, inwards and outwards

/// Length (mm) along a circle of `radius` from `direction` to that of (x, y), positive anticlockwise;
/// rational instead of an arctangent, 5 % more at 43 degrees, 10 % at 60.
double arc_from(const Eigen::Vector2d& direction, const Eigen::Vector3d& p, double radius) {
  const double along = direction.x() * p.x() + direction.y() * p.y();
  const double across = direction.x() * p.y() - direction.y() * p.x();
  const double denominator = std::sqrt(p.x() * p.x() + p.y() * p.y()) + along;
  return denominator > 0 ? 2 * radius * across / denominator : 1e9;
}

/// 1 at 0, smoothly 0 from |t| = 1 on.
double bump(double t) {
  const double inside = std::max(0.0, 1 - t * t);
  return inside * inside;
}

/// Distances (mm) to the surfaces of the heart, negative inside.
struct HeartDistances {
  double lv_cavity, lv_wall, rv_cavity, outside, base;
};

class Biventricle {
 public:
  explicit Biventricle(const PhantomParams& params)
      : scale_(params.scale),
        length_scale_(params.length_scale),
        wall_share_(std::min(params.wall_scale, 1.0)),
        roughness_(params.roughness_mm / params.scale),
        blood_pools_(params.blood_pools),
        scar_(params.scar),
        scar_depth_(params.scar_depth),
        border_width_(params.border_mm),
        isthmus_width_(params.isthmus_mm),
        seed_(params.seed),
        shape_(heart_shape(params)) {}

  Label label_at(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d p = point / scale_ + kOrigin;
    HeartDistances d{};
    d.base = kBaseNormal.dot(p) - shape_.base_height;
    d.lv_wall = shape_.lv_outside.distance(p);
    const double rv_wall =
        smooth_min(shape_.rv_outside.distance(p), shape_.infundibulum_outside.distance(p), kInflowFillet);
    d.outside = smooth_max(smooth_min(d.lv_wall, rv_wall, kOuterFillet), d.base, kRimFillet);
    if (d.base >= 0) return kBackground;
    d.lv_cavity = shape_.lv_cavity.distance(p) + lv_roughness(p);
    if (d.lv_cavity < 0) return blood_pools_ ? 3 : kBackground;
    d.rv_cavity = rv_cavity(p, d.lv_wall);
    if (d.rv_cavity < 0) return blood_pools_ ? 4 : kBackground;
    if (d.outside >= 0) return kBackground;
    // Nearer to the RV cavity than to the LV: the bisector crosses the insertion at a blunt angle, and starts
    // in the middle of the cavity's rounded corner.
    if (d.lv_wall > d.rv_cavity + kCavityFillet / 4) return 2;
    return scar_ ? lv_tissue(p, d) : 1;
  }

 private:
  double noise(const Eigen::Vector3d& p, std::uint32_t salt) const {
    // Trabeculae run along the ventricle: cells are longer in z.
    const double coarse = value_noise(p.cwiseQuotient(Eigen::Vector3d(8, 8, 16)), seed_ + salt);
    const double fine = value_noise(p.cwiseQuotient(Eigen::Vector3d(5, 5, 10)), seed_ + salt + 1);
    return 0.7 * coarse + 0.3 * fine;
  }

  /// Roughness of the LV endocardium and two papillary muscles, all in proportion to roughness_mm.
  double lv_roughness(const Eigen::Vector3d& p) const {
    if (roughness_ == 0) return 0;
    double papillary = 0;
    for (const Eigen::Vector2d& direction : {Eigen::Vector2d(-0.28, 0.96), Eigen::Vector2d(-0.6, -0.8)})
      papillary += bump(arc_from(direction, p, 22) / 9) * bump((p.z() / length_scale_ + 14) / 22);
    return roughness_ * (wall_share_ * (3 * noise(p, 0) - 1.5) + 6 * papillary);
  }

  /// The RV pool. Roughness only thickens the free wall; the septal side stays smooth.
  double rv_cavity(const Eigen::Vector3d& p, double lv_wall) const {
    double inner =
        smooth_min(shape_.rv_cavity.distance(p), shape_.infundibulum_cavity.distance(p), kInflowFillet);
    if (roughness_ > 0) inner += 2 * roughness_ * noise(p, 7);
    return smooth_max(inner, -lv_wall, kCavityFillet);
  }

  /// 1 healthy, 5 scar core, 6 border zone. The core fills the inner part of the wall, or all of it; the
  /// border zone surrounds it through the whole wall and fills the isthmus, which cuts the core in two.
  Label lv_tissue(const Eigen::Vector3d& p, const HeartDistances& d) const {
    const Eigen::Vector2d at(arc_from(shape_.scar_direction, p, shape_.mid_wall_radius),
                             p.z() - shape_.scar_height);
    const double outline = shape_.scar_outline.distance({at.x() * kArcShare, at.y(), 0});
    if (outline - kWobble >= border_width_) return 1;
    const double patch = outline + kWobble * (2 * value_noise(p / 14, seed_ + 20) - 1);
    if (patch >= border_width_) return 1;
    double core = patch;
    if (isthmus_width_ > 0) {
      // As wide as asked at mid-wall; the endocardial end is a quarter narrower.
      const double middle = kIsthmusNormal.dot(at) + 0.004 * at.squaredNorm() - 1.5;
      core = smooth_max(core, isthmus_width_ / 2 - std::abs(middle), 3);
    }
    if (scar_depth_ < 1) {
      const double wall = d.lv_cavity - d.lv_wall;
      core = smooth_max(core, d.lv_cavity - scar_depth_ * wall, 3);
    }
    return core < 0 ? 5 : 6;
  }

  double scale_, length_scale_;
  double wall_share_;  // roughness is less in a thinner wall, or else it would go through at the apex
  double roughness_;
  bool blood_pools_, scar_;
  double scar_depth_, border_width_, isthmus_width_;
  std::uint32_t seed_;
  HeartShape shape_;
};

}  // namespace

Body biventricle_body(const PhantomParams& params) {
  Body body;
  const HeartShape shape = heart_shape(params);
  body.centre_mm = params.scale * ((shape.low + shape.high) / 2 - kOrigin);
  body.half_extent_mm = params.scale * (shape.high - shape.low) / 2;
  body.radius_mm = body.half_extent_mm.norm();
  body.label_at = [heart = Biventricle(params)](const Eigen::Vector3d& p) { return heart.label_at(p); };
  return body;
}

}  // namespace voxtet
