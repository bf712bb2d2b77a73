#include "walls/measure_wall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/digest.h"
#include "phantom/make_phantom.h"
#include "support/wall_bodies.h"

namespace voxtet {
namespace {

using test::Body;
using test::measure;
using test::sample;

void expect_accurate(const std::string& name, const Body& body, const LabelVolume& volume) {
  const test::ThicknessErrors e = test::thickness_errors(body, volume);
  ::testing::Test::RecordProperty(name, "bias " + std::to_string(e.bias) + " p95 " + std::to_string(e.p95));
  EXPECT_GT(e.count, 1000u) << name;
  EXPECT_LE(std::abs(e.bias), 0.1) << name;
  EXPECT_LE(e.p95, 0.25) << name;
}

LabelVolume heart(bool pools) {
  PhantomParams params;
  params.blood_pools = pools;
  return make_phantom(params).value();
}

TEST(MeasureWall, IsAccurateOnSphericalShells) {
  const Eigen::Vector3d voxel(1, 1, 1), straight(0, 0, 0);
  expect_accurate("7_17", test::shell(7, 17), sample(test::shell(7, 17), voxel, straight));
  expect_accurate("10_20", test::shell(10, 20), sample(test::shell(10, 20), voxel, {20, 30, 40}));
  expect_accurate("20_23_5", test::shell(20, 23.5), sample(test::shell(20, 23.5), voxel, straight));
}

TEST(MeasureWall, IsAccurateOnWallsOfTwoVoxels) {
  expect_accurate("20_22", test::shell(20, 22), sample(test::shell(20, 22), {1, 1, 1}, {0, 0, 0}));
}

TEST(MeasureWall, IsAccurateOnEllipsoidalShells) {
  const Body near = test::ellipsoidal_shell(12, 7, 17), round = test::ellipsoidal_shell(15, 10, 20);
  expect_accurate("7_17", near, sample(near, {1, 1, 1}, {0, 0, 0}));
  expect_accurate("10_20", round, sample(round, {1, 1, 1}, {15, 25, 35}));
}

// The second rotation keeps the slices from repeating themselves: about one axis alone, voxels cannot tell a
// slab of 8 mm from one of 8.5.
TEST(MeasureWall, IsAccurateOnAnObliqueSlabOfThickSlices) {
  RunContext ctx;
  for (const double thickness : {8.0, 5.4}) {
    const Body body = test::slab(thickness);
    const LabelVolume thick = sample(body, {1, 1, 3}, {37, 21, 0});
    expect_accurate("slab", body, interpolate_slices(thick, 2, ctx).value());
  }
}

TEST(MeasureWall, PotentialRunsFromTheInnerToTheOuterSurface) {
  RunContext ctx;
  const Body body = test::shell(10, 20);
  const WallField field = measure(sample(body, {1, 1, 1}, {0, 0, 0}), {{1}, {2}}, ctx).value();
  const Eigen::Vector3d direction = Eigen::Vector3d(1, 2, -2) / 3;
  for (const double r : {10.0, 11.0, 13.0, 16.0, 19.0, 20.0})
    EXPECT_NEAR(field.potential_at(r * direction), (1 / 10.0 - 1 / r) / (1 / 10.0 - 1 / 20.0), 0.02) << r;
}

TEST(MeasureWall, IsTheSameForAnyNumberOfThreads) {
  const LabelVolume volume = sample(test::shell(7, 17), {1, 1.2, 1.5}, {20, 30, 40});
  RunContext one, three;
  three.threads = 3;
  const WallField a = measure(volume, {{1}, {2}}, one).value(),
                  b = measure(volume, {{1}, {2}}, three).value();
  EXPECT_EQ(a.thickness_mm, b.thickness_mm);
  EXPECT_EQ(a.potential, b.potential);
  EXPECT_EQ(a.in_wall, b.in_wall);
}

// The digests hold natively and in WebAssembly.
TEST(MeasureWall, IsTheSameOnEveryPlatform) {
  RunContext ctx;
  const LabelVolume volume = heart(false);
  const WallField field = measure(volume, {{1, 2}, {}}, ctx).value();
  EXPECT_EQ(digest_of(ScalarVolume{field, field.thickness_mm}),
            "25bee1996d03fb5506438c4914689ac6b55006d403c3ca17e72563c58eec4d3c");
  EXPECT_EQ(digest_of(ScalarVolume{field, field.potential}),
            "2ed446e1335196f8ad1e1eaa70e5316dba9c3c042eaaf87e2b10e45023c60c1f");
}

TEST(MeasureWall, FindsAClosedCavityWithoutALabel) {
  RunContext ctx;
  const LabelVolume volume = sample(test::shell(10, 20), {1, 1, 1}, {0, 0, 0});
  const WallField known = measure(volume, {{1}, {2}}, ctx).value();
  const WallField found = measure(test::only({1}, volume), {{1}, {}}, ctx).value();
  EXPECT_EQ(known.thickness_mm, found.thickness_mm);
}

/// A hemisphere of a shell, cut open by a tilted plane.
Body cup(const Eigen::Vector3d& up) {
  Body body = test::shell(12, 20);
  body.label_at = [whole = body.label_at, up](const Eigen::Vector3d& p) -> Label {
    return p.dot(up.normalized()) < 4 ? whole(p) : kBackground;
  };
  return body;
}

TEST(MeasureWall, TakesTheRimOfAnOpenCupForNoSurface) {
  const Body body = cup({1, 2, 3});
  for (const bool labelled : {true, false}) {
    LabelVolume volume = sample(body, {1, 1, 1}, {0, 0, 0});
    RunContext ctx;
    WallLabels labels{{1}, {2}};
    if (!labelled) volume = test::only({1}, volume), labels.inner = {};
    const WallField field = measure(volume, labels, ctx).value();
    // In the middle of the wall, right below the rim and far from it.
    const Eigen::Vector3d up = Eigen::Vector3d(1, 2, 3).normalized(), side = up.unitOrthogonal();
    for (const double height : {2.5, -2.0, -10.0})
      EXPECT_NEAR(field.thickness_at(std::sqrt(256 - height * height) * side + height * up), 8, 0.6)
          << height << (labelled ? " labelled" : " not labelled");
  }
}

TEST(MeasureWall, FindsBothVentriclesOfAHeartWithoutPools) {
  RunContext ctx;
  const LabelVolume with = heart(true), without = heart(false);
  ASSERT_EQ(with.size, without.size);
  const WallField known = measure(with, {{1, 2}, {3, 4}}, ctx).value();
  const WallField found = measure(without, {{1, 2}, {}}, ctx).value();
  std::vector<double> difference;
  for (int k = 0; k < with.size[2]; ++k)
    for (int j = 0; j < with.size[1]; ++j)
      for (int i = 0; i < with.size[0]; ++i) {
        if (with.at(i, j, k) != 1 && with.at(i, j, k) != 2) continue;
        const Eigen::Vector3d p = with.to_mm({1.0 * i, 1.0 * j, 1.0 * k});
        difference.push_back(std::abs(known.thickness_at(p) - found.thickness_at(p)));
      }
  std::sort(difference.begin(), difference.end());
  EXPECT_LT(difference[difference.size() * 9 / 10], 0.05);
}

// Through the septum it is as far from the left to the right ventricle as the wall is thick there; the free
// walls are measured to the outside.
TEST(MeasureWall, MeasuresSeptumAndFreeWallsOfAHeart) {
  RunContext ctx;
  const LabelVolume volume = heart(true);
  const WallField field = measure(volume, {{1, 2}, {3, 4}}, ctx).value();
  std::vector<double> right;
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i)
        if (volume.at(i, j, k) == 2)
          right.push_back(field.thickness_at(volume.to_mm({1.0 * i, 1.0 * j, 1.0 * k})));
  std::sort(right.begin(), right.end());
  EXPECT_NEAR(right[right.size() / 2], 4.5, 0.5);
  EXPECT_GT(right.front(), 2);
  EXPECT_LT(right[right.size() * 99 / 100], 9);
}

void expect_refused(const LabelVolume& volume, const WallLabels& labels, const std::string& part) {
  RunContext ctx;
  const Result<WallField> field = measure(volume, labels, ctx);
  ASSERT_FALSE(field.ok()) << part;
  EXPECT_EQ(field.error().code, ErrorCode::kUsage);
  EXPECT_NE(field.error().message.find("sizing.thickness[0]"), std::string::npos) << field.error().message;
  EXPECT_NE(field.error().message.find(part), std::string::npos) << field.error().message;
}

TEST(MeasureWall, RefusesWhatHasNoThickness) {
  const LabelVolume shell = sample(test::shell(7, 12), {1, 1, 1}, {0, 0, 0});
  expect_refused(shell, {{}, {2}}, "found no labels");
  expect_refused(shell, {{1}, {7}}, "found 7, which the volume does not hold");
  expect_refused(shell, {{1, 2}, {2}}, "label 2 is listed twice");
  expect_refused(sample(test::shell(0, 9), {1, 1, 1}, {0, 0, 0}), {{1}, {}}, "an inner and an outer side");
  LabelVolume sheared = shell;
  sheared.index_to_mm(0, 1) += 0.4;
  expect_refused(sheared, {{1}, {2}}, "not at right angles");
}

TEST(MeasureWall, RefusesAWallThatItsInnerLabelDoesNotTouch) {
  LabelVolume volume = sample(test::shell(7, 12), {1, 1, 1}, {0, 0, 0});
  for (Label& label : volume.labels)
    if (label == 2) label = kBackground;
  volume.labels[0] = 2;
  expect_refused(volume, {{1}, {2}}, "none of the inner labels touches the wall");
}

}  // namespace
}  // namespace voxtet
