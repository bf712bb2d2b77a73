#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sizing/build_sizing_field.h"
#include "support/label_bodies.h"

namespace voxtet {
namespace {

/// All of it label 1, voxels of 1 mm, from (0, 0, 0) to (19, 19, 19).
LabelVolume block() {
  return test::make_volume(20, 20, 20, [](int, int, int) { return 1; });
}

/// Label 3 in the half x > 9.5 of the block, on a grid twice as fine, turned about z by a right angle.
LabelVolume painted_half() {
  LabelVolume mask = test::make_volume(40, 40, 40, [](int, int j, int) { return j < 20 ? 3 : 0; });
  mask.index_to_mm << 0, -0.5, 0, 19.25, 0.5, 0, 0, -0.25, 0, 0, 0.5, -0.25, 0, 0, 0, 1;
  return mask;
}

struct Side {
  std::vector<const LabelVolume*> masks;
  std::vector<const ScalarVolume*> images;
  std::vector<std::string> warnings;
};

Result<SizingField> build(SizingParams params, Side& side) {
  params.gradation = 1;
  params.masks.resize(std::max(params.masks.size(), side.masks.size()));
  params.images.resize(side.images.size());
  RunContext ctx;
  ctx.on_warning = [&](const std::string&, const std::string& message) { side.warnings.push_back(message); };
  return build_sizing_field(block(), params, ctx, {{}, side.masks, side.images});
}

TEST(MaskSize, HoldsWhereTheMaskIsPaintedOnWhateverGrid) {
  const LabelVolume mask = painted_half();
  Side side{{&mask}, {}, {}};
  SizingParams params;
  params.edge_mm = 4;
  params.masks.resize(1);
  params.masks[0].edges = {{3, 1.5}};
  const SizingField field = build(params, side).value();
  for (const double x : {10.0, 14.0, 19.0}) EXPECT_NEAR(field.at({x, 10, 10}), 1.5, 1e-6) << x;
  EXPECT_NEAR(field.at({9, 10, 10}), 2.5, 1e-6);
  EXPECT_NEAR(field.at({7, 10, 10}), 4, 1e-6);
}

TEST(MaskSize, ALonePaintedVoxelBetweenGridPointsIsNotLost) {
  LabelVolume mask = test::make_volume(1, 1, 1, [](int, int, int) { return 1; });
  mask.index_to_mm.diagonal().head<3>().setConstant(0.1);
  mask.index_to_mm.topRightCorner<3, 1>() << 8.3, 8.4, 8.4;
  Side side{{&mask}, {}, {}};
  SizingParams params;
  params.edge_mm = 4;
  params.masks.resize(1);
  params.masks[0].edges = {{1, 2}};
  EXPECT_NEAR(build(params, side).value().at({8, 8, 8}), 2, 1e-6);
}

void expect_refused(const Result<SizingField>& field, ErrorCode code, const std::string& part) {
  ASSERT_FALSE(field.ok()) << part;
  EXPECT_EQ(field.error().code, code);
  EXPECT_NE(field.error().message.find(part), std::string::npos) << field.error().message;
}

TEST(MaskSize, RefusesMasksThatSayNothing) {
  const LabelVolume mask = painted_half();
  LabelVolume elsewhere = mask;
  elsewhere.index_to_mm(0, 3) += 500;
  Side side{{&mask}, {}, {}};
  SizingParams params;
  params.masks.resize(1);
  MaskSize& rule = params.masks[0];
  rule.name = "paint.nii";
  expect_refused(build(params, side), ErrorCode::kUsage, "sizing.masks[0].edges: found none");
  rule.edges = {{4, 1}};
  expect_refused(build(params, side), ErrorCode::kUsage, "found 4, which the mask 'paint.nii' does not hold");
  rule.edges = {{3, 1}, {3, 2}};
  expect_refused(build(params, side), ErrorCode::kUsage,
                 "sizing.masks[0].edges[1].label: label 3 has a size");
  rule.edges = {{3, 0}};
  expect_refused(build(params, side), ErrorCode::kUsage, "sizing.masks[0].edges[0].edge_mm: found 0");
  rule.edges = {{3, 1}};
  side.masks = {&elsewhere};
  expect_refused(build(params, side), ErrorCode::kUsage, "lies in the volume");
}

/// 2 mm at x = 0, 4 mm at x = 20, linear, on a grid of 10 mm.
ScalarVolume ramp() {
  ScalarVolume image;
  image.size = {3, 3, 3};
  image.index_to_mm.diagonal().head<3>().setConstant(10);
  for (int at = 0; at < 27; ++at) image.values.push_back(2.F + static_cast<float>(at % 3));
  return image;
}

TEST(ImageSize, StandsInPlaceOfTheGlobalSize) {
  const ScalarVolume image = ramp();
  Side side{{}, {&image}, {}};
  for (const double edge_mm : {1.0, 9.0}) {
    SizingParams params;
    params.edge_mm = edge_mm;
    const SizingField field = build(params, side).value();
    for (const double x : {0.0, 5.0, 12.0, 19.0}) EXPECT_NEAR(field.at({x, 7, 11}), 2 + x / 10, 1e-5) << x;
  }
  EXPECT_TRUE(side.warnings.empty());
}

TEST(ImageSize, WhereItHasNoSizeTheGlobalOneStandsAndIsWarnedOf) {
  ScalarVolume image = ramp();
  for (std::size_t at = 0; at < 27; ++at)
    if (at % 3 == 0) image.values[at] = at % 2 ? 0 : std::numeric_limits<float>::quiet_NaN();
  image.index_to_mm(0, 3) = -5;  // sizes from x = 5 to 15, half a voxel further on both sides
  Side side{{}, {&image}, {}};
  SizingParams params;
  params.edge_mm = 2;
  const SizingField field = build(params, side).value();
  EXPECT_NEAR(field.at({9, 9, 9}), 3.4, 1e-5);
  EXPECT_NEAR(field.at({19, 9, 9}), 4, 1e-5);
  ASSERT_TRUE(side.warnings.empty());
  image.index_to_mm(0, 3) = -11;
  EXPECT_NEAR(build(params, side).value().at({17, 9, 9}), 2, 1e-5);
  ASSERT_EQ(side.warnings.size(), 1U);
  EXPECT_NE(side.warnings[0].find("no size in 30.00 % of the labelled voxels"), std::string::npos)
      << side.warnings[0];
}

TEST(ImageSize, BeyondTheBoundsIsWarnedOf) {
  const ScalarVolume image = ramp();  // 2 to 3.9 mm in the volume
  Side side{{}, {&image}, {}};
  SizingParams params;
  params.edge_mm = 3;
  params.edge_min_mm = 2.5;
  params.edge_max_mm = 3.5;
  const SizingField field = build(params, side).value();
  EXPECT_NEAR(field.at({0, 9, 9}), 2.5, 1e-5);
  EXPECT_NEAR(field.at({19, 9, 9}), 3.5, 1e-5);
  ASSERT_EQ(side.warnings.size(), 2U);
  EXPECT_NE(side.warnings[0].find("sizing.images[0]: sizes go down to 2 mm, below sizing.edge_min_mm"),
            std::string::npos)
      << side.warnings[0];
  EXPECT_NE(side.warnings[1].find("mm, above sizing.edge_max_mm, which holds: 3.5 mm"), std::string::npos)
      << side.warnings[1];
}

TEST(ImageSize, RefusesSizesThatAreNone) {
  ScalarVolume image = ramp();
  Side side{{}, {&image}, {}};
  image.values[5] = -1;
  expect_refused(build({}, side), ErrorCode::kBadInput,
                 "sizing.images[0]: voxel (2, 1, 0) asks for an edge of -1");
  image.values[5] = std::numeric_limits<float>::infinity();
  expect_refused(build({}, side), ErrorCode::kBadInput, "sizing.images[0]: voxel (2, 1, 0)");
  image = ramp();
  image.index_to_mm(2, 3) = 100;
  expect_refused(build({}, side), ErrorCode::kBadInput, "no size in any labelled voxel");
}

TEST(SizeRegion, OutsideOfTheVolumeChangesNothingAndIsWarnedOf) {
  Side side;
  SizingParams params;
  params.regions.resize(2);
  params.regions[0].name = "far";
  params.regions[0].centre_mm = {500, 0, 0};
  params.regions[1].centre_mm = {10, 10, 10};
  params.regions[1].edge_mm = 1.5;
  const SizingField field = build(params, side).value();
  EXPECT_NEAR(field.at({10, 10, 10}), 1.5, 1e-6);
  ASSERT_EQ(side.warnings.size(), 1U);
  EXPECT_NE(side.warnings[0].find("sizing.regions[0] 'far'"), std::string::npos) << side.warnings[0];
}

TEST(BuildSizingField, SaysWhichTargetsAreBeyondTheBounds) {
  Side side;
  SizingParams params;
  params.edge_min_mm = 1;
  params.edge_max_mm = 4;
  params.edge_mm = 5;
  params.regions.resize(1);
  params.regions[0].centre_mm = {10, 10, 10};
  params.regions[0].edge_mm = 0.5;
  const SizingField field = build(params, side).value();
  EXPECT_FLOAT_EQ(static_cast<float>(field.at({10, 10, 10})), 1);
  EXPECT_EQ(side.warnings,
            (std::vector<std::string>{
                "sizing.edge_mm: 5 mm is above sizing.edge_max_mm, which holds: 4 mm",
                "sizing.regions[0].edge_mm: 0.5 mm is below sizing.edge_min_mm, which holds: 1 mm"}));
}

// Contradictory rules are no error: the smallest wins, whatever the order.
TEST(SizeRegion, OverlappingRegionsTakeTheSmallestSize) {
  Side side;
  SizingParams params;
  params.edge_mm = 5;
  params.regions.resize(2);
  for (SizeRegion& region : params.regions) region.centre_mm = {10, 10, 10}, region.radius_mm = 4;
  params.regions[0].edge_mm = 1.5;
  params.regions[1].edge_mm = 4;
  EXPECT_NEAR(build(params, side).value().at({10, 10, 10}), 1.5, 1e-6);
}

}  // namespace
}  // namespace voxtet
