// The continuous label field under the surface.
#include "remesh/field/label_field.h"
#include "field_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/topology/label_topology.h"
#include "support/label_bodies.h"
#include "support/label_surface.h"
#include "support/random_labels.h"
#include "support/test_random.h"
#include "support/test_surfaces.h"
#include "surface/extract/extract_surface.h"

namespace voxtet::remesh {
namespace {

using Eigen::Vector3d;

/// A ball of radius 9 around (15, 15, 15), label 1, under a smooth sphere.
LabelField smooth_ball_field() {
  return {test::ball_volume(31, 15, 9), test::sphere(Vector3d::Constant(15), 9, 4, 1, 0)};
}

Vector3d random_direction(test::TestRandom& random) {
  Vector3d d = Vector3d::Zero();
  while (d.norm() < 0.1)
    for (int i = 0; i < 3; ++i) d[i] = random.below(2001) / 1000.0 - 1;
  return d.normalized();
}

TEST(LabelField, HasTheLabelsOfTheVolumeAtVoxelCentresAndBackgroundAround) {
  const LabelVolume volume = test::random_volume(14, 4, 3);
  const LabelField field = field_of(volume);
  const int pad = LabelField::kPad;
  std::size_t wrong = 0;
  for (int k = 0; k < field.grid().size[2]; ++k)
    for (int j = 0; j < field.grid().size[1]; ++j)
      for (int i = 0; i < field.grid().size[0]; ++i) {
        const auto v = static_cast<std::size_t>(i + field.grid().size[0] * (j + field.grid().size[1] * k));
        const Label label = volume.at_or_background(i - pad, j - pad, k - pad);
        wrong += field.centre_labels()[v] != label || field.at_index(Vector3d(i, j, k)) != label;
      }
  EXPECT_EQ(field.grid().size[0], 14 + 2 * pad);
  EXPECT_EQ(wrong, 0U);
}

/// Pieces, cavities and handles of the first label.
std::array<std::uint32_t, 3> topology_of(const LabelVolume& volume) {
  RunContext ctx;
  const LabelTopology topology = label_topology(extract_surface(volume, {}, ctx).value()).labels.at(0);
  return {topology.components, topology.cavities, topology.handles};
}

TEST(LabelField, JoinsOneLabelBetweenVoxelCentresAsItsSurfaceDoes) {
  constexpr int kFiner = 12;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const LabelVolume volume = test::random_volume(4, 1, seed);
    const LabelField field = field_of(volume);
    const std::array<int, 3>& size = field.grid().size;
    const LabelVolume fine =
        test::make_volume(kFiner * (size[0] - 1) + 1, kFiner * (size[1] - 1) + 1, kFiner * (size[2] - 1) + 1,
                          [&](int i, int j, int k) { return field.at_index(Vector3d(i, j, k) / kFiner); });
    EXPECT_EQ(topology_of(fine), topology_of(volume)) << seed;
  }
}

TEST(LabelField, ChangesItsLabelWhereTheSurfaceIs) {
  const LabelField field = smooth_ball_field();
  test::TestRandom random(7);
  for (int trial = 0; trial < 500; ++trial) {
    const Vector3d direction = random_direction(random), centre = Vector3d::Constant(15);
    EXPECT_EQ(field.at(centre + 8.92 * direction), 1);
    EXPECT_EQ(field.at(centre + 9.08 * direction), 0);
  }
}

TEST(LabelField, JoinsVoxelsOfSeveralLabelsAlongTheDiagonalsOfTheExtraction) {
  // Two voxels of label 1 across the diagonal of a cell inside label 2, along and against (1, 1, 1).
  for (const bool along : {true, false}) {
    const LabelVolume volume = test::make_volume(8, 8, 8, [&](int i, int j, int k) {
      const bool border = std::min({i, j, k}) < 1 || std::max({i, j, k}) > 6;
      const bool one = (i == 3 && j == 3 && k == 3) || (i == 4 && j == 4 && k == (along ? 4 : 2));
      return border ? 0 : one ? 1 : 2;
    });
    const SurfaceMesh surface = test::label_surface(volume);
    const LabelField field(volume, surface);
    const Label middle = field.at(Vector3d(3.5, 3.5, along ? 3.5 : 2.5));
    EXPECT_EQ(middle, along ? 1 : 2);
    const std::vector<LabelTopology> labels = label_topology(surface).labels;
    EXPECT_EQ(labels.front().components, along ? 1U : 2U) << "the extraction joins otherwise";
  }
}

TEST(LabelField, LeavesWaysBetweenTwoLabelsOpenThroughAThirdOne) {
  // A wall of label 1 between background and label 2, pierced where two voxels touch along the diagonal of
  // the extraction, both nearly lost to the wall.
  const auto label = [](int i, int j, int k) -> Label {
    if (std::min({i, j, k}) < 1 || std::max({i, j, k}) > 10) return 0;
    if (i == 5 && j == 5 && k == 5) return 0;
    if (i == 6 && j == 6 && k == 6) return 2;
    return k < 5 ? 0 : k > 6 ? 2 : 1;
  };
  const LabelVolume volume = test::make_volume(12, 12, 12, label);
  SurfaceMesh surface = test::label_surface(volume);
  for (Vector3d& p : surface.points)
    for (const Vector3d& centre : {Vector3d(5, 5, 5), Vector3d(6, 6, 6)})
      if ((p - centre).norm() < 0.8) p = centre + 0.3 * (p - centre);
  const LabelField field(volume, surface);
  for (int step = 0; step <= 100; ++step) {
    const Label found = field.at(Vector3d::Constant(5 + 0.01 * step));
    EXPECT_NE(found, 1) << step;
  }
}

TEST(LabelField, KnowsDistanceAndDepthBesideAnInterface) {
  const LabelField field = smooth_ball_field();
  test::TestRandom random(8);
  int known = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const double inside = random.below(601) / 1000.0 - 0.3;
    const Vector3d p = Vector3d::Constant(15) + (9 - inside) * random_direction(random);
    const std::optional<double> distance = field.distance(p, 1, 0);
    if (!distance) {
      // A cell with one label at all corners: the interface is outside of it.
      EXPECT_EQ(field.depth(p, 1), inside > 0 ? 1 : -1);
      continue;
    }
    ++known;
    EXPECT_NEAR(*distance, inside, 0.08);
    EXPECT_NEAR(*field.distance(p, 0, 1), -*distance, 1e-12);
    EXPECT_NEAR(field.depth(p, 1), inside, 0.08);
    EXPECT_NEAR(field.depth(p, 0), -inside, 0.08);
    EXPECT_FALSE(field.distance(p, 1, 5).has_value());
  }
  EXPECT_GT(known, 350);
  EXPECT_FALSE(field.distance(Vector3d::Constant(15), 1, 0).has_value());
  EXPECT_EQ(field.depth(Vector3d::Constant(15), 1), 1);
  EXPECT_LT(field.depth(Vector3d::Constant(15), 0), 0);
}

TEST(LabelField, MeasuresInMillimetresOfObliqueFrames) {
  // Slices of 3 mm with a wall across them, mirrored.
  LabelVolume volume = test::make_volume(14, 14, 14, [](int, int, int k) {
    return k < 2 || k > 11 ? 0 : k < 7 ? 1 : 2;
  });
  volume.index_to_mm.topLeftCorner<3, 3>() << 0, -1.5, 0, 1.5, 0, 0, 0, 0, 3;
  volume.index_to_mm.topRightCorner<3, 1>() << -4, 90, 11;
  const LabelField field = field_of(volume);
  for (const double off : {-0.3, -0.1, 0.1, 0.3}) {
    const Vector3d p = volume.to_mm({6.7, 7.2, 6.5 + off});
    ASSERT_TRUE(field.distance(p, 2, 1).has_value());
    EXPECT_NEAR(*field.distance(p, 2, 1), 3 * off, 0.03);
    EXPECT_NEAR(field.depth(p, 2), 3 * off, 0.03);
  }
  EXPECT_EQ(field.grid().smallest_spacing_mm(), 1.5);
}

TEST(LabelField, FindsCrossingsWhereTheLabelChanges) {
  LabelVolume volume = test::heart_volume(32, 30, 28);
  volume.index_to_mm.topLeftCorner<3, 3>() << 0, -0.8, 0.1, 0.9, 0.1, 0, 0, 0.2, 1.5;
  volume.index_to_mm.topRightCorner<3, 1>() << 5, -20, 100;
  const LabelField field = field_of(volume);
  test::TestRandom random(4);
  int found = 0;
  for (int trial = 0; trial < 8000; ++trial) {
    const auto pick = [&] {
      Vector3d index;
      for (int d = 0; d < 3; ++d) index[d] = random.below(100 * (field.grid().size[d] + 20)) / 100.0 - 10;
      return field.to_mm(index);
    };
    const Vector3d a = pick(), b = pick();
    const Label label_a = field.at(a), label_b = field.at(b);
    if (label_a == label_b) continue;
    Label behind = label_a;
    const Vector3d p = field.crossing(a, label_a, b, label_b, behind);
    EXPECT_NE(behind, label_a);
    const Vector3d step = (b - a).normalized() * 1e-3;
    EXPECT_EQ(field.at(p - step), label_a);
    EXPECT_NE(field.at(p + step), label_a);
    ++found;
  }
  EXPECT_GT(found, 500);
}

TEST(LabelField, IsBackgroundFarAwayAndWhereThereIsNoNumber) {
  const LabelField field = field_of(test::ball_volume(8, 3.5, 3));
  EXPECT_EQ(field.at({1e300, -1e300, 5}), kBackground);
  EXPECT_EQ(field.at(Vector3d::Constant(std::numeric_limits<double>::quiet_NaN())), kBackground);
  EXPECT_EQ(field.at({3.5, 3.5, 3.5}), 1);
}

}  // namespace
}  // namespace voxtet::remesh
