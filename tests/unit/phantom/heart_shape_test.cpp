#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>

#include "geometry/grid/distance_transform.h"
#include "geometry/topology/label_components.h"
#include "heart.h"

namespace voxtet {
namespace {

const Eigen::Vector3d kAxis(-12, -2, 14);  // where the LV's axis meets its widest circle, at scale 1
const Eigen::Vector3d kBaseNormal(0.06, 0.08, std::sqrt(1 - 0.06 * 0.06 - 0.08 * 0.08));

std::map<Label, double> volumes_ml(const PhantomParams& params) {
  const LabelVolume volume = heart(params);
  std::map<Label, double> ml;
  for (const Label label : volume.labels) ml[label] += volume.voxel_mm3() / 1000;
  return ml;
}

PhantomParams smooth_heart() {
  PhantomParams params;
  params.roughness_mm = 0;
  params.spacing_mm.setConstant(2);
  return params;
}

/// Length (mm) of a label on the ray from a point.
double length_mm(const PhantomParams& params, Label label, const Eigen::Vector3d& from,
                 const Eigen::Vector3d& direction) {
  const auto body = phantom_body(params);
  double length = 0;
  for (double r = 0; r < 150; r += 0.05) length += 0.05 * (body(from + r * direction) == label);
  return length;
}

TEST(HeartShape, WallScaleThickensTheLvWallOutwardsAndKeepsTheCavities) {
  PhantomParams params = smooth_heart();
  const auto adult = volumes_ml(params);
  double last = 0;
  for (const double factor : {0.5, 0.8, 1.25, 2.0}) {
    params.wall_scale = factor;
    EXPECT_NEAR(length_mm(params, 1, kAxis, {-1, 0, 0}), 9.5 * factor, 0.11);
    EXPECT_NEAR(length_mm(params, 1, kAxis, {0, 0, -1}), 6 * factor, 0.11);
    auto ml = volumes_ml(params);
    EXPECT_NEAR(ml[3] / adult.at(3), 1, 0.01) << factor;
    EXPECT_NEAR(ml[4] / adult.at(4), 1, 0.04) << factor;
    EXPECT_GT(ml[1], 1.2 * last);
    last = ml[1];
  }
}

TEST(HeartShape, LengthScaleStretchesCavitiesAlongTheAxisAndKeepsWalls) {
  PhantomParams params = smooth_heart();
  const auto adult = volumes_ml(params);
  for (const double factor : {0.75, 1.15, 1.35}) {
    params.length_scale = factor;
    EXPECT_NEAR(length_mm(params, 3, kAxis, {0, 0, -1}), 46 * factor, 0.11);
    EXPECT_NEAR(length_mm(params, 3, kAxis, {-1, 0, 0}), 24, 0.11);
    EXPECT_NEAR(length_mm(params, 1, kAxis, {0, 0, -1}), 6, 0.11);
    auto ml = volumes_ml(params);
    EXPECT_NEAR(ml[3] / adult.at(3), factor, 0.015);
    EXPECT_NEAR(ml[4] / adult.at(4), factor, 0.08);
  }
}

TEST(HeartShape, RvDilationMovesTheFreeWallAwayFromTheSeptum) {
  PhantomParams params = smooth_heart();
  const auto adult = volumes_ml(params);
  const Eigen::Vector3d from = kAxis + Eigen::Vector3d(0, -9, 6);
  const double depth = length_mm(params, 4, from, {1, 0, 0});
  double last = 0;
  for (const double factor : {0.7, 1.5, 2.0, 2.5, 3.5}) {
    params.rv_dilation = factor;
    EXPECT_NEAR(length_mm(params, 4, from, {1, 0, 0}) / depth, factor, 0.05 * factor);
    EXPECT_NEAR(length_mm(params, 2, from, {1, 0, 0}), params.rv_wall_mm, 0.5);
    auto ml = volumes_ml(params);
    EXPECT_NEAR(ml[3] / adult.at(3), 1, 0.01);
    EXPECT_NEAR(ml[1] / adult.at(1), 1, 0.03);
    EXPECT_GT(ml[4], 1.3 * last);
    if (factor == 2) {
      EXPECT_NEAR(ml[4] / ml[3], 1.3, 0.1);
    }
    last = ml[4];
  }
}

TEST(HeartShape, RvWallGrowsOutwards) {
  PhantomParams params = smooth_heart();
  const auto adult = volumes_ml(params);
  double last = 0;
  for (const double thickness : {3.0, 4.5, 7.0, 10.0}) {
    params.rv_wall_mm = thickness;
    EXPECT_NEAR(length_mm(params, 2, kAxis + Eigen::Vector3d(0, -9, 6), {1, 0, 0}), thickness,
                0.07 * thickness + 0.1);
    auto ml = volumes_ml(params);
    EXPECT_NEAR(ml[4] / adult.at(4), 1, 0.01);
    EXPECT_NEAR(ml[3] / adult.at(3), 1, 0.01);
    EXPECT_GT(ml[2], 1.2 * last);
    last = ml[2];
  }
}

/// A scar through the whole wall, in which there is no isthmus.
PhantomParams closed_scar() {
  PhantomParams params = smooth_heart();
  params.scar = true;
  params.scar_depth = 1;
  params.isthmus_mm = 0;
  return params;
}

struct Extent {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< from kAxis
  double height_mm = 0, angle_deg = 0;                 ///< from end to end
};

double angle_deg(const Eigen::Vector3d& from_axis) {
  return std::atan2(from_axis.y(), from_axis.x()) * 180 / std::numbers::pi;
}
/// The same direction as an angle from -180 to 180 degrees.
double turned(double degrees) {
  return std::remainder(degrees, 360);
}

Extent extent_of_core(const PhantomParams& params) {
  const LabelVolume volume = heart(params);
  std::vector<Eigen::Vector3d> core;
  volume.visit([&](int i, int j, int k, std::size_t at) {
    if (volume.labels[at] == 5) core.push_back(volume.to_mm(i, j, k) - kAxis);
  });
  Extent extent;
  for (const auto& p : core) extent.centroid += p / static_cast<double>(core.size());
  double low = 1e9, high = -1e9, left = 0, right = 0;
  for (const auto& p : core) {
    low = std::min(low, p.z());
    high = std::max(high, p.z());
    const double angle = turned(angle_deg(p) - angle_deg(extent.centroid));
    left = std::min(left, angle);
    right = std::max(right, angle);
  }
  extent.height_mm = high - low;
  extent.angle_deg = right - left;
  return extent;
}

TEST(HeartShape, ScarLiesWhereItIsAskedFor) {
  PhantomParams params = closed_scar();
  const Extent present = extent_of_core(params);
  EXPECT_NEAR(angle_deg(present.centroid), 143, 4);
  for (const double angle : {-143.0, -80.0, 37.0, 127.0, 160.0, 180.0}) {
    params.scar_angle_deg = angle;
    EXPECT_NEAR(turned(angle_deg(extent_of_core(params).centroid) - angle_deg(present.centroid) - angle), 0,
                6)
        << angle;
  }
  params = closed_scar();
  params.scar_length_mm = 25;
  const double middle = extent_of_core(params).centroid.z();
  for (const double height : {-15.0, 12.0}) {
    params.scar_height_mm = height;
    EXPECT_NEAR(extent_of_core(params).centroid.z() - middle, height, 2) << height;
  }
}

TEST(HeartShape, ScarIsAsLargeAsAsked) {
  PhantomParams params = closed_scar();
  params.spacing_mm.setConstant(1.5);
  for (const double length : {16.0, 30.0, 50.0}) {
    params.scar_length_mm = length;
    EXPECT_NEAR(extent_of_core(params).height_mm, length, 4.5)
        << length;  // its outline wavers by 2 at each end
  }
  for (const double wall : {0.6, 1.0, 1.5})
    for (const double arc : {20.0, 45.0, 72.0}) {
      params = closed_scar();
      params.spacing_mm.setConstant(1.5);
      params.wall_scale = wall;
      params.scar_arc_mm = arc;
      const double radius = 28 + 9.5 / 2 * (wall - 1);
      const double found = extent_of_core(params).angle_deg * std::numbers::pi / 180 * radius;
      EXPECT_NEAR(found, arc, 4.5 + arc * 0.1) << arc << " at wall_scale " << wall;
    }
}

TEST(HeartShape, ScarTakesFromTheLeftVentricleOnlyWhereverItIs) {
  for (const double angle : {-180.0, -143.0, -100.0, -70.0, 100.0, 150.0}) {
    PhantomParams params = smooth_heart();
    params.scar_angle_deg = angle;
    params.scar_arc_mm = 60;
    const LabelVolume healthy = heart(params);
    params.scar = true;
    const LabelVolume scarred = heart(params);
    ASSERT_EQ(healthy.size, scarred.size);
    for (std::size_t v = 0; v < healthy.labels.size(); ++v)
      if (scarred.labels[v] != healthy.labels[v]) {
        ASSERT_EQ(healthy.labels[v], 1);
        ASSERT_TRUE(scarred.labels[v] == 5 || scarred.labels[v] == 6);
      }
  }
}

TEST(HeartShape, SaysThatNothingIsLeftOfTheScar) {
  PhantomParams params = smooth_heart();
  params.scar = true;
  params.scar_arc_mm = 20;
  params.scar_length_mm = 16;
  params.isthmus_mm = 40;
  const Result<LabelVolume> volume = make_phantom(params);
  ASSERT_FALSE(volume.ok());
  EXPECT_EQ(volume.error().code, ErrorCode::kUsage);
  EXPECT_EQ(volume.error().message.rfind("phantom.scar: no voxel of its core is left", 0), 0U);
}

/// Height (mm) of a point above the base plane.
double above_base_mm(const PhantomParams& params, const Eigen::Vector3d& mm) {
  return params.scale * (kBaseNormal.dot(mm / params.scale - kAxis) - 22 * params.length_scale);
}

/// One piece a label, or two of a core that an isthmus cuts; pools within walls but at the base; nothing
/// outside the grid.
void expect_valid(const PhantomParams& params) {
  const LabelVolume volume = heart(params);
  const std::vector<std::uint32_t> pieces = count_components(volume.size, volume.labels);
  for (Label label = 1; label <= 6; ++label)
    if (label == 5 && params.isthmus_mm > 0) {
      EXPECT_GE(pieces[label], 1U);
      EXPECT_LE(pieces[label], 2U);
    } else {
      EXPECT_EQ(pieces[label], 1U) << "label " << label;
    }

  std::vector<std::uint8_t> outside(volume.labels.size());
  volume.visit([&](int i, int j, int k, std::size_t at) {
    outside[at] = volume.labels[at] == kBackground &&
                  above_base_mm(params, volume.to_mm(i, j, k)) < -2 * params.spacing_mm[0];
  });
  const std::vector<float> distance = distance_to_mask_mm(volume.size, volume.spacing_mm(), outside);
  float thinnest = 1e9F;
  for (std::size_t v = 0; v < distance.size(); ++v)
    if (volume.labels[v] == 3 || volume.labels[v] == 4) thinnest = std::min(thinnest, distance[v]);
  // The endocardium wavers by 1.5 times the roughness to both sides, and less where the wall is thin.
  const double apex =
      6 * params.wall_scale * params.scale - 1.5 * params.roughness_mm * std::min(params.wall_scale, 1.0);
  EXPECT_GE(thinnest, 0.85 * std::min(apex, params.rv_wall_mm * params.scale));

  const auto body = phantom_body(params);
  std::size_t beyond = 0;
  for (int k = -3; k < volume.size[2] + 3; ++k)
    for (int j = -3; j < volume.size[1] + 3; ++j)
      for (int i = -3; i < volume.size[0] + 3; ++i)
        beyond += !volume.contains(i, j, k) && body(volume.to_mm(i, j, k)) != kBackground;
  EXPECT_EQ(beyond, 0U);
}

class Draws {
 public:
  explicit Draws(std::uint32_t seed) : random_(seed) {}
  double between(double low, double high) { return low + (high - low) * (random_() / 4294967295.0); }
  double either(double low, double high) { return random_() % 2 ? low : high; }

 private:
  std::mt19937 random_;
};

using Draw = double (Draws::*)(double, double);

TEST(HeartShape, AnyDrawOfAPopulationIsValid) {
  Draws draws(1);
  for (int n = 0; n < 40; ++n) {
    const bool tetralogy = n % 2;
    PhantomParams params;
    params.spacing_mm.setConstant(2);
    if (n % 5 == 0)
      params.rotation_deg = {draws.between(-90, 90), draws.between(-90, 90), draws.between(-90, 90)};
    params.seed = n;
    params.roughness_mm = draws.between(0.4, 1);
    params.scale = tetralogy ? draws.between(1, 1.2) : draws.between(1.05, 1.25);
    params.wall_scale = draws.between(0.55, 0.85);
    params.length_scale = draws.between(0.9, 1.15);
    params.rv_dilation = tetralogy ? draws.between(2, 3) : draws.between(1.7, 2);
    params.rv_wall_mm = tetralogy ? draws.between(3, 5.5) : draws.between(3, 4);
    params.scar = true;
    params.scar_angle_deg = draws.between(-60, 150);
    params.scar_height_mm = draws.between(-12, 12);
    params.scar_arc_mm = draws.between(30, 65);
    params.scar_length_mm = draws.between(25, 50);
    params.scar_depth = draws.between(0.4, 0.7);
    params.border_mm = draws.between(2, 5);
    params.isthmus_mm = draws.between(5, 10);
    SCOPED_TRACE(n);
    expect_valid(params);
  }
}

TEST(HeartShape, AnyCombinationWithinTheRangesIsValid) {
  Draws draws(2);
  for (int n = 0; n < 24; ++n) {
    const Draw draw = n % 2 ? &Draws::between : &Draws::either;
    PhantomParams params;
    params.spacing_mm.setConstant(2);
    params.seed = n;
    params.roughness_mm = (draws.*draw)(0, 1.2);
    params.wall_scale = (draws.*draw)(0.5, 2);
    params.length_scale = (draws.*draw)(0.75, 1.35);
    params.rv_dilation = (draws.*draw)(0.7, 3.5);
    params.rv_wall_mm = (draws.*draw)(3, 10);
    params.scar = true;
    params.scar_angle_deg = (draws.*draw)(-180, 180);
    params.scar_height_mm = (draws.*draw)(-20, 20);
    params.scar_arc_mm = (draws.*draw)(20, 72);
    params.scar_length_mm = (draws.*draw)(16, 60);
    params.isthmus_mm = (draws.*draw)(0, 8);
    SCOPED_TRACE(n);
    expect_valid(params);
  }
}

}  // namespace
}  // namespace voxtet
