#include "walls/wall_layers.h"

#include <gtest/gtest.h>

namespace voxtet {
namespace {

/// A wall of label 3 between the planes x = 0 and x = 12 mm. With `two` inner spaces, one on either side, so
/// that the outer surface has no share; else the outer surface is at x = 12.
WallField flat_wall(bool two) {
  WallField field;
  field.wall = {3};
  field.size = {17, 5, 5};
  field.index_to_mm.topRightCorner<3, 1>().setConstant(-2);
  field.invert();
  field.inner_shares.resize(two ? 2 : 1);
  for (int at = 0; at < 17 * 5 * 5; ++at) {
    const float x = static_cast<float>(at % 17 - 2);
    field.thickness_mm.push_back(12);
    field.potential.push_back(x / 12);
    field.in_wall.push_back(x > 0 && x < 12);
    field.inner_shares[0].push_back(1 - x / 12);
    if (two) field.inner_shares[1].push_back(x / 12);
  }
  return field;
}

LabelVolume volume() {
  LabelVolume volume;
  volume.size = {15, 3, 3};
  volume.index_to_mm(0, 3) = -0.5;
  volume.labels.assign(135, 0);
  for (int at = 0; at < 135; ++at) volume.labels[static_cast<std::size_t>(at)] = at % 15 < 13 ? 3 : 0;
  return volume;
}

TEST(WallLayers, CutAWallAtEqualStepsOfThePotential) {
  for (const bool two : {false, true})
    for (const std::uint32_t count : {1U, 2U, 3U, 4U, 5U}) {
      const WallField field = flat_wall(two);
      const std::vector<LayeredWall> walls{{field, count}};
      const WallLayers layers(volume(), walls);
      ASSERT_TRUE(layers.has_wall(0));
      std::vector<Label> met;
      for (double x = 0.05; x < 12; x += 0.1) {
        const Label label = layers.at(3, {x, 1, 1});
        EXPECT_TRUE(layers.is_layer(label));
        EXPECT_EQ(layers.parent(label), 3);
        if (met.empty() || met.back() != label) met.push_back(label);
        EXPECT_EQ(met.size(), 1 + static_cast<std::size_t>(count * x / 12)) << count << " at " << x;
      }
      EXPECT_EQ(met.size(), count);
    }
}

TEST(WallLayers, KnowHowFarTheirSheetsAre) {
  const WallField field = flat_wall(false);
  const std::vector<LayeredWall> walls{{field, 3}};
  const WallLayers layers(volume(), walls);
  const Label first = layers.at(3, {1, 1, 1}), second = layers.at(3, {6, 1, 1}),
              third = layers.at(3, {11, 1, 1});
  EXPECT_NEAR(layers.lead({3, 1, 1}, first, second), 1.0 / 12, 1e-6);
  EXPECT_NEAR(layers.lead({3, 1, 1}, second, first), -1.0 / 12, 1e-6);
  EXPECT_NEAR(layers.lead({9, 1, 1}, second, third), -1.0 / 12, 1e-6);
  EXPECT_NEAR((layers.lead_gradient({4, 1, 1}, first, second) - Eigen::Vector3d(-1.0 / 12, 0, 0)).norm(), 0,
              1e-6);
  EXPECT_NEAR(layers.depth_mm({7, 1, 1}, second), 1, 1e-5);
  EXPECT_NEAR(layers.depth_mm({9, 1, 1}, second), -1, 1e-5);
  EXPECT_NEAR(layers.depth_mm({9, 1, 1}, third), 1, 1e-5);
}

TEST(WallLayers, AreNoneForLabelsOutsideOfTheWall) {
  const WallField field = flat_wall(false);
  const std::vector<LayeredWall> walls{{field, 2}, {field, 3}};
  LabelVolume other = volume();
  other.index_to_mm(0, 3) = 100;
  EXPECT_TRUE(WallLayers(other, walls).empty());
  const WallLayers layers(volume(), walls);
  EXPECT_TRUE(layers.has_wall(0));
  EXPECT_FALSE(layers.has_wall(1)) << "the first wall has the label";
  EXPECT_EQ(layers.at(2, {6, 1, 1}), 2);
  EXPECT_EQ(layers.at(3, {6, 100, 1}), 3) << "nothing is known there";
}

TEST(WallLayers, NeedLabelsAboveTheVolumes) {
  const WallField field = flat_wall(false);
  const std::vector<LayeredWall> walls{{field, 3}};
  LabelVolume high = volume();
  high.labels[134] = 65532;
  EXPECT_FALSE(WallLayers(high, walls).lacks_labels());
  high.labels[134] = 65533;
  const WallLayers layers(high, walls);
  EXPECT_TRUE(layers.lacks_labels());
  EXPECT_TRUE(layers.empty());
}

TEST(WallLayers, GoAgainFromSurfacesAndTets) {
  const WallField field = flat_wall(false);
  const std::vector<LayeredWall> walls{{field, 2}};
  const WallLayers layers(volume(), walls);
  const Label in = layers.at(3, {1, 1, 1}), out = layers.at(3, {11, 1, 1});
  const Sides between{std::max(in, out), std::min(in, out)};
  const SurfaceMesh surface{
      {{0, 0, 0}, {9, 9, 9}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}, {between, {out, 0}}};
  const SurfaceMesh merged = merge_layers(surface, layers);
  EXPECT_EQ(merged.points.size(), 3U);
  ASSERT_EQ(merged.triangles.size(), 1U);
  EXPECT_EQ(merged.triangles[0], (Triangle{0, 1, 2}));
  EXPECT_EQ(merged.sides[0], (Sides{3, 0}));
  const TetMesh tets =
      merge_layers(TetMesh{surface.points, {{0, 2, 3, 1}}, {in}, surface.triangles, surface.sides}, layers);
  EXPECT_EQ(tets.labels, std::vector<Label>{3});
  EXPECT_EQ(tets.points.size(), 4U);
  EXPECT_EQ(tets.face_sides, (std::vector<Sides>{{3, 0}}));
}

}  // namespace
}  // namespace voxtet
