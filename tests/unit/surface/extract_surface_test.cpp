#include "surface/extract/extract_surface.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>

#include "base/digest.h"
#include "extracted.h"
#include "geometry/elements/surface_measures.h"
#include "support/check_surface.h"
#include "support/label_bodies.h"
#include "support/random_labels.h"
#include "support/test_random.h"

namespace voxtet {
namespace {

using test::extract;
using test::is_valid_surface;
using test::kBothMethods;

TEST(ExtractSurface, GivesClosedManifoldsForAllSmallBinaryBlocks) {
  for (int mask = 1; mask < 4096; ++mask) {
    const LabelVolume volume =
        test::make_volume(2, 2, 3, [mask](int i, int j, int k) { return (mask >> (i + 2 * j + 4 * k)) & 1; });
    for (const ExtractMethod method : kBothMethods)
      ASSERT_TRUE(is_valid_surface(extract(volume, method)))
          << mask << " method " << static_cast<int>(method);
  }
}

TEST(ExtractSurface, GivesClosedManifoldsForRandomLabels) {
  for (int seed = 0; seed < 60; ++seed) {
    const LabelVolume volume = test::random_volume(12, 2 + seed % 4, static_cast<std::uint64_t>(seed));
    ASSERT_TRUE(is_valid_surface(extract(volume))) << seed;
  }
}

TEST(ExtractSurface, GivesClosedManifoldsForBinaryNoise) {
  for (int seed = 0; seed < 50; ++seed) {
    const LabelVolume volume = test::random_volume(12, 1, static_cast<std::uint64_t>(1000 + seed));
    ASSERT_TRUE(is_valid_surface(extract(volume))) << seed;
  }
}

TEST(ExtractSurface, GivesClosedManifoldsForLabelsWithoutBackground) {
  test::TestRandom random(5);
  const LabelVolume volume =
      test::make_volume(9, 8, 7, [&](int, int, int) { return 65532 + random.below(4); });
  const SurfaceMesh surface = extract(volume);
  EXPECT_TRUE(is_valid_surface(surface));
  EXPECT_EQ(test::labels_of(surface), (std::vector<Label>{65532, 65533, 65534, 65535}));
}

TEST(ExtractSurface, HasTheEulerNumbersOfKnownBodies) {
  const LabelVolume torus = test::make_volume(
      40, 40, 16, [](int i, int j, int k) { return test::in_torus(i - 19.5, j - 19.5, k - 7.5, 12, 5); });
  const LabelVolume double_torus = test::make_volume(70, 40, 16, [](int i, int j, int k) {
    return test::in_torus(i - 19.5, j - 19.5, k - 7.5, 12, 5) ||
           test::in_torus(i - 47.5, j - 19.5, k - 7.5, 12, 5);
  });
  const LabelVolume shell = test::make_volume(30, 30, 30, [](int i, int j, int k) {
    const double r = std::sqrt((i - 14.5) * (i - 14.5) + (j - 14.5) * (j - 14.5) + (k - 14.5) * (k - 14.5));
    return r <= 13 && r >= 8;
  });
  const auto euler = [](const LabelVolume& volume, ExtractMethod method) {
    const SurfaceMesh surface = extract(volume, method);
    EXPECT_TRUE(is_valid_surface(surface));
    return test::label_topologies(surface).at(0).euler();
  };
  for (const ExtractMethod method : kBothMethods) {
    EXPECT_EQ(euler(test::ball_volume(24, 11.5, 9.3), method), 2);
    EXPECT_EQ(euler(torus, method), 0);
    EXPECT_EQ(euler(double_torus, method), -2);
    EXPECT_EQ(euler(shell, method), 4);
  }
}

TEST(ExtractSurface, SeparatesVoxelsThatTouchAtAnEdgeInMarchingCubes) {
  const LabelVolume volume = test::make_volume(2, 2, 1, [](int i, int j, int) { return i == j; });
  const std::vector<test::LabelTopology> found =
      test::label_topologies(extract(volume, ExtractMethod::kMarchingCubes));
  EXPECT_EQ(found.at(0).components, 2U);
}

TEST(ExtractSurface, ClosesLabelsAtTheImageBorder) {
  const LabelVolume full = test::make_volume(5, 4, 3, [](int, int, int) { return 1; });
  const LabelVolume halves = test::make_volume(5, 4, 3, [](int i, int, int) { return i < 2 ? 7 : 3; });
  for (const ExtractMethod method : kBothMethods) EXPECT_TRUE(is_valid_surface(extract(full, method)));
  const SurfaceMesh surface = extract(halves);
  EXPECT_TRUE(is_valid_surface(surface));
  EXPECT_EQ(test::labels_of(surface), (std::vector<Label>{3, 7}));
}

TEST(ExtractSurface, FollowsObliqueMirroredAndShearedAffines) {
  const LabelVolume heart = test::heart_volume(24, 20, 22);
  for (const ExtractMethod method : kBothMethods) {
    const std::vector<double> index_volumes = enclosed_volumes_mm3(extract(heart, method));
    for (const double mirror : {1.0, -1.0}) {
      LabelVolume moved = heart;
      Eigen::Matrix3d shear = Eigen::Matrix3d::Identity();
      shear(0, 1) = 0.3;
      moved.index_to_mm.topLeftCorner<3, 3>() =
          Eigen::AngleAxisd(0.9, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix() * shear *
          Eigen::Vector3d(mirror * 0.7, 1.3, 4).asDiagonal();
      moved.index_to_mm.topRightCorner<3, 1>() = Eigen::Vector3d(-120, 340, 55);
      const SurfaceMesh surface = extract(moved, method);
      EXPECT_TRUE(is_valid_surface(surface));
      for (const Label label : test::labels_of(surface))
        EXPECT_NEAR(enclosed_volume_mm3(surface, label), 0.7 * 1.3 * 4 * index_volumes[label],
                    1e-9 * index_volumes[label])
            << label << " mirror " << mirror;
    }
  }
}

TEST(ExtractSurface, PutsVerticesOnLatticeEdgesBetweenDifferentVoxels) {
  LabelVolume volume =
      test::make_volume(3, 3, 3, [](int i, int j, int k) { return i == 1 && j == 1 && k == 1; });
  const SurfaceMesh surface = extract(volume);
  ASSERT_EQ(surface.points.size(), 6U);
  ASSERT_EQ(surface.triangles.size(), 8U);
  for (const Eigen::Vector3d& p : surface.points)
    EXPECT_DOUBLE_EQ((p - Eigen::Vector3d(1, 1, 1)).norm(), 0.5);
}

TEST(ExtractSurface, ChoosesMarchingCubesForOneLabelAndTetsForMore) {
  const LabelVolume ball = test::ball_volume(12, 5.5, 4);
  EXPECT_EQ(digest_of(extract(ball)), digest_of(extract(ball, ExtractMethod::kMarchingCubes)));
  const LabelVolume heart = test::heart_volume(24, 20, 22);
  EXPECT_EQ(digest_of(extract(heart)), digest_of(extract(heart, ExtractMethod::kMarchingTets)));
  EXPECT_NE(digest_of(extract(heart)), digest_of(extract(heart, ExtractMethod::kMarchingCubes)));
}

TEST(ExtractSurface, MergesLabelsToTheSmallestInMarchingCubes) {
  const LabelVolume volume = test::make_volume(4, 3, 3, [](int i, int, int) { return i < 2 ? 9 : 4; });
  for (const Sides& sides : extract(volume, ExtractMethod::kMarchingCubes).sides)
    ASSERT_EQ(sides, (Sides{4, kBackground}));
}

TEST(ExtractSurface, GivesTheSameBytesEveryTime) {
  const LabelVolume volume = test::random_volume(20, 4, 77);
  EXPECT_EQ(digest_of(extract(volume)), digest_of(extract(volume)));
}

TEST(ExtractSurface, RejectsVolumesWithoutSurface) {
  RunContext ctx;
  const auto code_of = [&](const LabelVolume& volume) {
    const Result<SurfaceMesh> result = extract_surface(volume, {}, ctx);
    EXPECT_FALSE(result.ok());
    EXPECT_FALSE(result.error().message.empty());
    return result.error().code;
  };
  const LabelVolume ball = test::ball_volume(8, 3.5, 3);
  EXPECT_EQ(code_of(test::make_volume(4, 4, 4, [](int, int, int) { return 0; })), ErrorCode::kBadInput);
  EXPECT_EQ(code_of(LabelVolume{}), ErrorCode::kBadInput);
  LabelVolume broken = ball;
  broken.labels.pop_back();
  EXPECT_EQ(code_of(broken), ErrorCode::kBadInput);
  broken = ball;
  broken.index_to_mm.col(1) = broken.index_to_mm.col(0);
  EXPECT_EQ(code_of(broken), ErrorCode::kBadInput);
  broken = ball;
  broken.index_to_mm(0, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code_of(broken), ErrorCode::kBadInput);
}

TEST(ExtractSurface, ReportsProgressAndHonoursCancel) {
  const LabelVolume ball = test::ball_volume(16, 7.5, 6);
  RunContext ctx;
  std::vector<double> fractions;
  ctx.on_progress = [&](const std::string& stage, double fraction) {
    EXPECT_EQ(stage, "surface");
    fractions.push_back(fraction);
  };
  ASSERT_TRUE(extract_surface(ball, {}, ctx).ok());
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_DOUBLE_EQ(fractions.back(), 1.0);
  int asked = 0;
  ctx.on_cancelled = [&] { return ++asked > 3; };
  const Result<SurfaceMesh> stopped = extract_surface(ball, {}, ctx);
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().code, ErrorCode::kCancelled);
  EXPECT_EQ(asked, 4);
}

}  // namespace
}  // namespace voxtet
