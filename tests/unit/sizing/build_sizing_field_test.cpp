#include "sizing/build_sizing_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/digest.h"
#include "geometry/elements/rotation.h"

namespace voxtet {
namespace {

/// Label 1 for i < 10, label 2 from there on, 4 voxels of background around.
LabelVolume two_halves() {
  LabelVolume volume;
  volume.size = {28, 24, 24};
  volume.index_to_mm.topLeftCorner<3, 3>() =
      rotation_from_degrees({10, 20, 30}) * Eigen::Vector3d(1, 1.2, 1.5).asDiagonal();
  volume.index_to_mm.topRightCorner<3, 1>() = Eigen::Vector3d(-5, 7, 11);
  volume.labels.assign(volume.voxel_count(), kBackground);
  for (int k = 4; k < 20; ++k)
    for (int j = 4; j < 20; ++j)
      for (int i = 4; i < 24; ++i) volume.labels[volume.offset(i, j, k)] = i < 14 ? 1 : 2;
  return volume;
}

SizingField build(const LabelVolume& volume, const SizingParams& params) {
  RunContext ctx;
  const Result<SizingField> field = build_sizing_field(volume, params, ctx);
  EXPECT_TRUE(field.ok()) << (field ? "" : field.error().message);
  return field ? *field : SizingField{};
}

double at_voxel(const LabelVolume& volume, const SizingField& field, double i, double j, double k) {
  return field.at(volume.to_mm({i, j, k}));
}

TEST(BuildSizingField, CoversTheVolumeAndTwoVoxelsAroundIt) {
  const LabelVolume volume = two_halves();
  const SizingField field = build(volume, {});
  EXPECT_EQ(field.size, (std::array<int, 3>{32, 28, 28}));
  EXPECT_EQ(field.h_mm.size(), 32u * 28u * 28u);
  const Eigen::Vector4d corner = field.index_to_mm * Eigen::Vector4d(2, 2, 2, 1);
  EXPECT_LT((corner.head<3>() - volume.to_mm({0, 0, 0})).norm(), 1e-12);
  EXPECT_LT((field.index_to_mm * field.mm_to_index - Eigen::Matrix4d::Identity()).norm(), 1e-12);
  for (const float h : field.h_mm) ASSERT_TRUE(std::isfinite(h) && h > 0);
}

TEST(BuildSizingField, GivesEachLabelItsSizeAndTheOthersTheGlobalOne) {
  const LabelVolume volume = two_halves();
  SizingParams params;
  params.edge_mm = 2;
  params.labels = {{2, 2.2}};
  params.gradation = 1;
  const SizingField field = build(volume, params);
  EXPECT_FLOAT_EQ(at_voxel(volume, field, 8, 12, 12), 2);
  EXPECT_FLOAT_EQ(at_voxel(volume, field, 19, 12, 12), 2.2F);
}

TEST(BuildSizingField, FillsTheBackgroundFromTheLabelsUpToTheLargestSize) {
  const LabelVolume volume = two_halves();
  SizingParams params;
  params.edge_max_mm = 3;
  params.gradation = 0.3;
  const SizingField field = build(volume, params);
  EXPECT_NEAR(at_voxel(volume, field, 2, 12, 12), 2 + 0.3 * 2, 1e-5);
  EXPECT_NEAR(at_voxel(volume, field, 0, 12, 12), 3, 1e-5);
  EXPECT_NEAR(*std::max_element(field.h_mm.begin(), field.h_mm.end()), 3, 1e-6);
}

TEST(BuildSizingField, WavesAskForTheEdgeThatKeepsTheirSpeed) {
  const LabelVolume volume = two_halves();
  SizingParams params;
  params.edge_mm = 4;
  params.gradation = 1;
  params.waves = {{.labels = {2}, .speed_mm_per_ms = 0.5, .error_percent = 2.5, .consistent_mass = 0}};
  // Measured: 2.5 % at 0.85 mm with lumped mass, for a diffusivity of 0.2118 mm^2/ms.
  EXPECT_NEAR(edge_of(params.waves[0]), 0.85, 2e-4);
  const SizingField field = build(volume, params);
  EXPECT_NEAR(*std::min_element(field.h_mm.begin(), field.h_mm.end()), 0.85, 2e-4);
  params.waves[0].speed_mm_per_ms = 0.25;
  EXPECT_NEAR(edge_of(params.waves[0]), 0.425, 1e-4);
  // What asks for less stays.
  params.labels = {{2, 0.3}};
  const SizingField finer = build(volume, params);
  EXPECT_NEAR(*std::min_element(finer.h_mm.begin(), finer.h_mm.end()), 0.3, 1e-5);
  params.waves[0].error_percent = 0;
  RunContext ctx;
  const auto refused = build_sizing_field(volume, params, ctx);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("sizing.waves[0].error_percent: found 0"), std::string::npos);
}

TEST(BuildSizingField, ClampsTargetsToTheBounds) {
  const LabelVolume volume = two_halves();
  SizingParams params;
  params.labels = {{1, 0.2}, {2, 90}};
  params.edge_min_mm = 0.5;
  params.edge_max_mm = 4;
  const SizingField field = build(volume, params);
  EXPECT_FLOAT_EQ(*std::min_element(field.h_mm.begin(), field.h_mm.end()), 0.5F);
  EXPECT_FLOAT_EQ(*std::max_element(field.h_mm.begin(), field.h_mm.end()), 4.F);
}

/// Expects edge_mm inside, the linear rise in the band and the surroundings beyond, along a ray from `start`.
void expect_profile(const SizingParams& params, const LabelVolume& volume, const Eigen::Vector3d& surface,
                    const Eigen::Vector3d& outward) {
  const SizingField field = build(volume, params);
  const SizeRegion& region = params.regions[0];
  const double tolerance = 0.02;  // trilinear interpolation of a curved profile between voxels
  EXPECT_NEAR(field.at(surface - 2.5 * outward), region.edge_mm, tolerance);
  for (const double share : {0.4, 0.6})
    EXPECT_NEAR(field.at(surface + share * region.band_mm * outward),
                region.edge_mm + share * (params.edge_mm - region.edge_mm), 0.06);
  EXPECT_NEAR(field.at(surface + (region.band_mm + 2) * outward), params.edge_mm, tolerance);
}

LabelVolume solid(int n) {
  LabelVolume volume;
  volume.size = {n, n, n};
  volume.index_to_mm.diagonal().head<3>().setConstant(0.5);
  volume.labels.assign(volume.voxel_count(), 1);
  return volume;
}

TEST(BuildSizingField, RegionsRiseLinearlyOverTheirBand) {
  const LabelVolume volume = solid(70);
  const Eigen::Vector3d middle = volume.to_mm({34, 34, 34});
  SizingParams params;
  params.edge_mm = 3;
  params.gradation = 1;
  params.regions.resize(1);
  SizeRegion& region = params.regions[0];
  region.centre_mm = middle;
  region.edge_mm = 1;
  region.band_mm = 6;
  region.radius_mm = 5;
  const Eigen::Vector3d direction = Eigen::Vector3d(1, 2, -1).normalized();
  expect_profile(params, volume, middle + 5 * direction, direction);

  region.shape = RegionShape::kCapsule;
  region.radius_mm = 3;
  region.centre_mm = middle - Eigen::Vector3d(0, 0, 4);
  region.end_mm = middle + Eigen::Vector3d(0, 0, 4);
  expect_profile(params, volume, middle + Eigen::Vector3d(3, 0, 2), Eigen::Vector3d::UnitX());
  expect_profile(params, volume, middle + Eigen::Vector3d(0, 0, 7), Eigen::Vector3d::UnitZ());

  region.shape = RegionShape::kBox;
  region.centre_mm = middle;
  region.half_size_mm = {4, 6, 3};
  region.axes_deg = {0, 0, 30};
  const Eigen::Vector3d axis = rotation_from_degrees(region.axes_deg).col(0);
  expect_profile(params, volume, middle + 4 * axis, axis);
}

TEST(BuildSizingField, RegionsDoNotDependOnTheirOrderNorRaiseSizes) {
  const LabelVolume volume = two_halves();
  SizingParams params;
  params.regions.resize(3);
  params.regions[0].centre_mm = volume.to_mm({10, 12, 12});
  params.regions[0].radius_mm = 4;
  params.regions[1].centre_mm = volume.to_mm({14, 12, 12});
  params.regions[1].radius_mm = 3;
  params.regions[1].edge_mm = 0.7;
  params.regions[1].band_mm = 0;
  params.regions[2].centre_mm = volume.to_mm({18, 12, 12});
  params.regions[2].edge_mm = 9;
  const SizingField one = build(volume, params);
  std::reverse(params.regions.begin(), params.regions.end());
  EXPECT_EQ(build(volume, params).h_mm, one.h_mm);
  for (int i = 4; i < 24; ++i) EXPECT_LE(at_voxel(volume, one, i, 12, 12), 2 + 1e-6);
  EXPECT_NEAR(at_voxel(volume, one, 14, 12, 12), 0.7, 1e-6);
}

TEST(BuildSizingField, GrowsWithTheDistanceToALabel) {
  LabelVolume volume = solid(40);
  volume.labels[volume.offset(20, 20, 20)] = 5;
  SizingParams params;
  params.edge_mm = 50;
  params.distances = {{5, 0.6, 0.2}};
  const SizingField field = build(volume, params);
  for (const Eigen::Vector3d& index :
       {Eigen::Vector3d(20, 20, 20), Eigen::Vector3d(3, 20, 20), Eigen::Vector3d(30, 31, 5)})
    EXPECT_NEAR(field.at(volume.to_mm(index)), 0.6 + 0.2 * 0.5 * (index - Eigen::Vector3d(20, 20, 20)).norm(),
                1e-4);

  volume.index_to_mm(0, 1) =
      0.2;  // sheared: straight paths over the grid, never shorter than the true distance
  const SizingField sheared = build(volume, params);
  for (const Eigen::Vector3d& index :
       {Eigen::Vector3d(20, 20, 20), Eigen::Vector3d(3, 20, 20), Eigen::Vector3d(30, 31, 5)}) {
    const double rise = 0.2 * (volume.linear() * (index - Eigen::Vector3d(20, 20, 20))).norm();
    const double found = sheared.at(volume.to_mm(index)) - 0.6;
    EXPECT_GE(found, rise - 1e-4);
    EXPECT_LE(found, 1.13 * rise + 1e-4);
  }
}

TEST(BuildSizingField, GivesTheSameBytesOnEveryPlatform) {
  LabelVolume volume = two_halves();
  SizingParams params;
  params.labels = {{1, 5}, {2, 1.3}};
  params.distances = {{1, 0.9, 0.17}};
  params.regions.resize(1);
  params.regions[0].shape = RegionShape::kBox;
  params.regions[0].centre_mm = volume.to_mm({7, 9, 10});
  params.regions[0].half_size_mm = {2, 3, 4};
  params.regions[0].axes_deg = {12, 34, 56};
  params.regions[0].edge_mm = 0.4;
  const SizingField field = build(volume, params);
  Sha256 sha;
  sha.update_values(field.h_mm.data(), field.h_mm.size());
  EXPECT_EQ(sha.hex(), "901caedcbf9a8a812f8634f478234c9cc0621af8ecf993013fbebcb47cdb6183");
}

TEST(BuildSizingField, NamesTheFieldThatIsWrong) {
  const LabelVolume volume = two_halves();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto expect_error = [&](const std::string& start, const auto& spoil) {
    SizingParams params;
    params.labels = {{1, 1.0}, {2, 1.5}};
    params.regions.resize(1);
    params.distances = {{2, 1, 0.2}};
    spoil(params);
    RunContext ctx;
    const Result<SizingField> field = build_sizing_field(volume, params, ctx);
    ASSERT_FALSE(field.ok()) << start;
    EXPECT_EQ(field.error().code, ErrorCode::kUsage);
    EXPECT_EQ(field.error().message.rfind("sizing." + start, 0), 0u) << field.error().message;
  };
  using P = SizingParams;
  expect_error("edge_mm:", [](P& p) { p.edge_mm = 0; });
  expect_error("edge_min_mm:", [&](P& p) { p.edge_min_mm = nan; });
  expect_error("edge_min_mm: found 60, expected at most edge_max_mm", [](P& p) { p.edge_min_mm = 60; });
  expect_error("edge_max_mm:", [](P& p) { p.edge_max_mm = INFINITY; });
  expect_error("gradation:", [](P& p) { p.gradation = 0; });
  expect_error("gradation:", [](P& p) { p.gradation = 1.01; });
  expect_error("gradation:", [&](P& p) { p.gradation = nan; });
  expect_error("labels[1].edge_mm: found -2", [](P& p) { p.labels[1].edge_mm = -2; });
  expect_error("labels[1].label: found 9, but the labels of the volume are 1, 2",
               [](P& p) { p.labels[1].label = 9; });
  expect_error("labels[0].label: found 0, the background", [](P& p) { p.labels[0].label = 0; });
  expect_error("labels[1].label: label 1 already has a size in sizing.labels[0]",
               [](P& p) { p.labels[1].label = 1; });
  expect_error("distances[0].label: found 3, but", [](P& p) { p.distances[0].label = 3; });
  expect_error("distances[0].edge_mm:", [](P& p) { p.distances[0].edge_mm = 0; });
  expect_error("distances[0].slope:", [](P& p) { p.distances[0].slope = -1; });
  expect_error("regions[0].radius_mm:", [](P& p) { p.regions[0].radius_mm = 0; });
  expect_error("regions[0].edge_mm:", [&](P& p) { p.regions[0].edge_mm = nan; });
  expect_error("regions[0].band_mm:", [](P& p) { p.regions[0].band_mm = -1; });
  expect_error("regions[0].centre_mm[2]:", [&](P& p) { p.regions[0].centre_mm[2] = nan; });
  expect_error("regions[0].half_size_mm[1]:", [](P& p) {
    p.regions[0].shape = RegionShape::kBox;
    p.regions[0].half_size_mm[1] = 0;
  });
  expect_error("regions[0].end_mm[0]:", [&](P& p) {
    p.regions[0].shape = RegionShape::kCapsule;
    p.regions[0].end_mm[0] = nan;
  });
}

TEST(BuildSizingField, RefusesVolumesThatMakeNoSense) {
  RunContext ctx;
  LabelVolume volume = two_halves();
  volume.labels.pop_back();
  EXPECT_EQ(build_sizing_field(volume, {}, ctx).error().code, ErrorCode::kBadInput);
  volume = two_halves();
  volume.index_to_mm.col(1) = volume.index_to_mm.col(0);
  EXPECT_EQ(build_sizing_field(volume, {}, ctx).error().code, ErrorCode::kBadInput);
  EXPECT_EQ(build_sizing_field(LabelVolume{}, {}, ctx).error().code, ErrorCode::kBadInput);
}

TEST(BuildSizingField, StopsWhenCancelled) {
  RunContext ctx;
  ctx.on_cancelled = [] { return true; };
  const Result<SizingField> field = build_sizing_field(two_halves(), {}, ctx);
  ASSERT_FALSE(field.ok());
  EXPECT_EQ(field.error().code, ErrorCode::kCancelled);
}

/// A wall of label 1 as thick as its voxels are far up: i / 2 mm, between i = 4 and i = 24.
WallField wedge(const LabelVolume& volume) {
  WallField wall;
  wall.wall = {1};
  wall.size = volume.size;
  wall.index_to_mm = volume.index_to_mm;
  wall.mm_to_index = volume.index_to_mm.inverse();
  wall.potential.assign(volume.voxel_count(), 0.5F);
  for (std::size_t at = 0; at < volume.voxel_count(); ++at) {
    wall.in_wall.push_back(volume.labels[at] == 1);
    wall.thickness_mm.push_back(static_cast<float>(at % static_cast<std::size_t>(volume.size[0])) / 2);
  }
  return wall;
}

SizingField build_with_wall(const LabelVolume& volume, SizingParams params, const ThicknessSize& rule) {
  params.gradation = 1;
  params.thickness = {rule};
  const std::vector<WallField> walls{wedge(volume)};
  RunContext ctx;
  return build_sizing_field(volume, params, ctx, {walls}).value();
}

TEST(BuildSizingField, LayersDivideTheThicknessOfAWall) {
  const LabelVolume volume = two_halves();
  SizingParams params;
  params.edge_mm = 9;
  ThicknessSize rule;
  rule.wall = {1};
  for (const std::uint32_t layers : {1U, 2U, 4U}) {
    rule.layers = layers;
    const SizingField field = build_with_wall(volume, params, rule);
    for (const int i : {4, 8, 13})
      EXPECT_NEAR(at_voxel(volume, field, i, 12, 12), i / 2.0 / layers, 1e-5) << layers;
    // Beyond the wall the other label's own size, as far as the gradation allows.
    EXPECT_GT(at_voxel(volume, field, 23, 12, 12), 13.0 / 2 / layers);
  }
}

TEST(BuildSizingField, ThicknessIsMappedToARangeOfSizes) {
  const LabelVolume volume = two_halves();
  ThicknessSize rule;
  rule.wall = {1};
  rule.thin_mm = 3;
  rule.thick_mm = 5;
  rule.edge_thin_mm = 1.5;
  rule.edge_thick_mm = 2.5;
  const SizingField field = build_with_wall(volume, {}, rule);
  EXPECT_NEAR(at_voxel(volume, field, 4, 12, 12), 1.5, 1e-5);
  EXPECT_NEAR(at_voxel(volume, field, 8, 12, 12), 2, 1e-5);
  EXPECT_NEAR(at_voxel(volume, field, 9, 12, 12), 2.25, 1e-5);
  EXPECT_NEAR(at_voxel(volume, field, 12, 12, 12), 2.5, 1e-5);
}

TEST(BuildSizingField, TheRangeOfThicknessIsThatOfTheWallUnlessGiven) {
  const LabelVolume volume = two_halves();
  ThicknessSize rule;
  rule.wall = {1};
  rule.edge_thin_mm = 1;
  rule.edge_thick_mm = 4;  // the wall's thickness runs from 2 to 6.5 mm
  const SizingField field = build_with_wall(volume, {}, rule);
  EXPECT_NEAR(at_voxel(volume, field, 4, 12, 12), 1, 1e-5);
  EXPECT_NEAR(at_voxel(volume, field, 8, 12, 12), 1 + 3 * (4 - 2) / 4.5, 1e-5);
  EXPECT_NEAR(at_voxel(volume, field, 12, 12, 12), 1 + 3 * (6 - 2) / 4.5, 1e-5);
}

TEST(BuildSizingField, TheSmallerOfLabelSizeAndThicknessHolds) {
  const LabelVolume volume = two_halves();
  SizingParams params;
  params.labels = {{1, 2.5}};
  ThicknessSize rule;
  rule.wall = {1};
  rule.layers = 1;
  const SizingField field = build_with_wall(volume, params, rule);
  EXPECT_NEAR(at_voxel(volume, field, 4, 12, 12), 2, 1e-5);
  EXPECT_NEAR(at_voxel(volume, field, 10, 12, 12), 2.5, 1e-5);
}

TEST(BuildSizingField, RefusesImpossibleRangesOfThickness) {
  const LabelVolume volume = two_halves();
  SizingParams params;
  params.thickness.resize(1);
  params.thickness[0].wall = {1};
  params.thickness[0].thin_mm = 5;
  params.thickness[0].thick_mm = 5;
  RunContext ctx;
  const Result<SizingField> field = build_sizing_field(volume, params, ctx);
  ASSERT_FALSE(field.ok());
  EXPECT_NE(field.error().message.find("sizing.thickness[0].thick_mm: found 5"), std::string::npos)
      << field.error().message;
}

}  // namespace
}  // namespace voxtet
