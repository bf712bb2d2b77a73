#include "surface/smooth/smooth_surface.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "base/digest.h"
#include "extracted.h"
#include "geometry/elements/surface_measures.h"
#include "smoothed.h"
#include "support/check_surface.h"
#include "support/label_bodies.h"
#include "support/random_labels.h"
#include "support/surface_labels.h"
#include "surface/extract/extract_surface.h"
#include "surface/smooth/surface_graph.h"

namespace voxtet {
namespace {

using test::extract;
using test::is_valid_surface;
using test::kBothMethods;
using test::smooth;

TEST(SmoothSurface, KeepsTheFacesOfNestedBoxesFlat) {
  const LabelVolume boxes = test::make_volume(24, 24, 24, [](int i, int j, int k) {
    const int depth = std::min({i, j, k, 23 - i, 23 - j, 23 - k});
    return depth < 2 ? 0 : depth < 6 ? 1 : depth < 9 ? 2 : 3;
  });
  const SurfaceMesh surface = smooth(extract(boxes), boxes);
  EXPECT_TRUE(is_valid_surface(surface));
  const std::vector<double> counts = test::label_counts(boxes);
  for (const Label label : {1, 2, 3})
    EXPECT_NEAR(enclosed_volume_mm3(surface, label), counts[label], 0.001 * counts[label]) << label;
  std::size_t flat = 0, inner = 0;
  for (const Eigen::Vector3d& p : surface.points) {
    const Eigen::Vector3d depth = p.cwiseMin(Eigen::Vector3d::Constant(23) - p);
    std::array<double, 3> sorted{depth.x(), depth.y(), depth.z()};
    std::sort(sorted.begin(), sorted.end());
    if (sorted[1] < sorted[0] + 3) continue;  // near an edge of the boxes
    ++inner;
    const double off =
        std::min({std::abs(sorted[0] - 1.5), std::abs(sorted[0] - 5.5), std::abs(sorted[0] - 8.5)});
    flat += off < 0.08 ? 1 : 0;
  }
  EXPECT_GT(inner, 100U);
  EXPECT_EQ(flat, inner);
}

TEST(SmoothSurface, KeepsTheVolumeOfSpecksWiresAndSheets) {
  const auto stick_out = [](int a, int b, int c) { return std::abs(a) + std::abs(b) + std::abs(c); };
  const std::vector<std::pair<const char*, LabelVolume>> bodies{
      {"one voxel",
       test::make_volume(7, 7, 7, [&](int i, int j, int k) { return stick_out(i - 3, j - 3, k - 3) == 0; })},
      {"two voxels",
       test::make_volume(7, 7, 7, [](int i, int j, int k) { return i / 2 == 1 && j == 3 && k == 3; })},
      {"two across a corner",
       test::make_volume(7, 7, 7, [](int i, int j, int k) { return i / 2 == 1 && j == i && k == i; })},
      {"four voxels",
       test::make_volume(7, 7, 7, [](int i, int j, int k) { return i / 2 == 1 && j / 2 == 1 && k == 3; })},
      {"seven voxels",
       test::make_volume(7, 7, 7, [&](int i, int j, int k) { return stick_out(i - 3, j - 3, k - 3) <= 1; })},
      {"wire",
       test::make_volume(20, 7, 7, [](int i, int j, int k) { return i > 2 && i < 17 && j == 3 && k == 3; })},
      {"staircase wire", test::make_volume(20, 21, 7,
                                           [](int i, int j, int k) {
                                             return i > 2 && i < 17 && (j == i || j == i + 1) && k == 3;
                                           })},
      {"sheet", test::make_volume(16, 16, 7, [](int i, int j, int k) {
         return i > 2 && i < 13 && j > 2 && j < 13 && k == 3;
       })}};
  for (const auto& [name, volume] : bodies)
    for (const ExtractMethod method : kBothMethods) {
      const double voxels = test::label_counts(volume)[1];
      const SurfaceMesh surface = smooth(extract(volume, method), volume);
      EXPECT_NEAR(enclosed_volume_mm3(surface, 1) / voxels, 1, 0.02) << name;
      EXPECT_TRUE(is_valid_surface(surface)) << name;
      const test::ChangedVoxels changed = test::changed_voxels(surface, volume);
      EXPECT_EQ(changed.inner + changed.thin, 0U) << name;
    }
}

TEST(SmoothSurface, KeepsTheThicknessOfAWireThatGrowsOutOfABody) {
  const LabelVolume wired = test::make_volume(30, 14, 14, [](int i, int j, int k) {
    return (i < 10 && j > 1 && j < 12 && k > 1 && k < 12) || (i < 28 && j == 7 && k == 7) ? 1 : 0;
  });
  for (const ExtractMethod method : kBothMethods) {
    const SurfaceMesh surface = smooth(extract(wired, method), wired);
    double distance = 0;
    int count = 0;
    for (const Eigen::Vector3d& p : surface.points)
      if (p.x() > 12 && p.x() < 26) {
        distance += std::hypot(p.y() - 7, p.z() - 7);
        ++count;
      }
    EXPECT_GE(distance, 0.45 * count);
  }
}

TEST(SmoothSurface, KeepsTheVolumeOfEveryLabel) {
  const LabelVolume heart = test::heart_volume(60, 44, 52);
  const SurfaceMesh raw = extract(heart);
  const SurfaceMesh surface = smooth(raw, heart);
  EXPECT_TRUE(is_valid_surface(surface));
  const std::vector<double> counts = test::label_counts(heart);
  for (const Label label : test::labels_of(surface))
    EXPECT_NEAR(enclosed_volume_mm3(surface, label), counts[label], 0.003 * counts[label]) << label;
  EXPECT_LE(staircase_energy_mm(surface), 0.1 * staircase_energy_mm(raw));
}

TEST(SmoothSurface, LeavesVolumesAloneWhenAsked) {
  const LabelVolume ball = test::ball_volume(20, 9.5, 6);
  SmoothParams params;
  params.keep_volume = false;
  EXPECT_NE(digest_of(smooth(extract(ball), ball, params)), digest_of(smooth(extract(ball), ball)));
}

TEST(SmoothSurface, KeepsLabelsOfVoxelCentresDeeperThanHalfAVoxel) {
  for (int seed = 0; seed < 6; ++seed) {
    const LabelVolume noise = test::random_volume(12, 1 + seed % 4, static_cast<std::uint64_t>(300 + seed));
    EXPECT_EQ(test::changed_voxels(smooth(extract(noise), noise), noise).inner, 0U) << seed;
  }
  const LabelVolume heart = test::heart_volume(60, 44, 52);
  const test::ChangedVoxels changed = test::changed_voxels(smooth(extract(heart), heart), heart);
  EXPECT_EQ(changed.inner, 0U);
  EXPECT_EQ(changed.thin, 0U);
  EXPECT_LE(static_cast<double>(changed.all), 0.002 * static_cast<double>(heart.voxel_count()));
}

TEST(SmoothSurface, MovesNoVertexFurtherThanItsClamp) {
  LabelVolume heart = test::heart_volume(40, 30, 36);
  heart.index_to_mm.topLeftCorner<3, 3>() =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -1, 2).normalized()).toRotationMatrix() *
      Eigen::Vector3d(-1.4, 1.4, 8).asDiagonal();
  const Eigen::Matrix3d to_index = heart.linear().inverse();
  const SurfaceMesh raw = extract(heart);
  for (const double reach : {0.5, 0.2}) {
    SmoothParams params;
    params.max_move_voxels = reach;
    const SurfaceMesh surface = smooth(raw, heart, params);
    double largest = 0;
    for (const Eigen::Vector3d& point : surface.points) {
      double nearest = 1;
      for (const Eigen::Vector3d& start : raw.points)
        nearest = std::min(nearest, (to_index * (point - start)).cwiseAbs().maxCoeff());
      largest = std::max(largest, nearest);
    }
    EXPECT_LE(largest, reach + 1e-9);
    EXPECT_GT(largest, 0.5 * reach);
  }
}

TEST(SmoothSurface, WorksInIndexSpace) {
  const LabelVolume heart = test::heart_volume(40, 30, 36);
  const std::vector<double> reference = enclosed_volumes_mm3(smooth(extract(heart), heart));
  for (const double mirror : {1.0, -1.0}) {
    LabelVolume moved = heart;
    moved.index_to_mm.topLeftCorner<3, 3>() =
        Eigen::AngleAxisd(0.9, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix() *
        Eigen::Vector3d(mirror * 1.4, 1.4, 8).asDiagonal();
    moved.index_to_mm.topRightCorner<3, 1>() = Eigen::Vector3d(70, -90, 1200);
    const SurfaceMesh surface = smooth(extract(moved), moved);
    EXPECT_TRUE(is_valid_surface(surface));
    for (const Label label : test::labels_of(surface))
      EXPECT_NEAR(enclosed_volume_mm3(surface, label) / moved.voxel_mm3(), reference[label],
                  1e-6 * reference[label])
          << label << " mirror " << mirror;
  }
}

TEST(SmoothSurface, KeepsSpecksAndPillarsFromCollapsing) {
  // A lone voxel, a pillar one voxel thick and a voxel of a second label inside the first.
  const LabelVolume volume = test::make_volume(20, 14, 14, [](int i, int j, int k) {
    if (i == 1 && j == 1 && k == 1) return 1;
    if (j == 1 && k == 8) return 1;
    if (i == 12 && j == 9 && k == 9) return 2;
    return i > 8 && i < 16 && j > 5 && k > 5 ? 1 : 0;
  });
  for (const ExtractMethod method : kBothMethods) {
    const SurfaceMesh raw = extract(volume, method);
    const SurfaceMesh surface = smooth(raw, volume);
    EXPECT_TRUE(is_valid_surface(surface));
    const auto least_area = [](const SurfaceMesh& s) {
      double least = std::numeric_limits<double>::infinity();
      for (const auto& [a, b, c] : s.triangles)
        least = std::min(least, triangle_area_mm2(s.points[a], s.points[b], s.points[c]));
      return least;
    };
    EXPECT_GE(least_area(surface), 0.005 * least_area(raw));
  }
}

TEST(SmoothSurface, LeavesFixedVerticesWhereTheyAre) {
  const LabelVolume noise = test::random_volume(10, 4, 21);
  const SurfaceMesh raw = extract(noise);
  const SurfaceMesh surface = smooth(raw, noise);
  const SurfaceGraph graph = build_surface_graph(raw);
  for (std::size_t v = 0; v < raw.points.size(); ++v) {
    ASSERT_TRUE(graph.kinds[v] != VertexKind::kFixed || surface.points[v] == raw.points[v]) << v;
  }
}

TEST(SmoothSurface, ReturnsTheInputForNoIterations) {
  const LabelVolume heart = test::heart_volume(24, 20, 22);
  const SurfaceMesh raw = extract(heart);
  SmoothParams params;
  params.iterations = 0;
  EXPECT_EQ(digest_of(smooth(raw, heart, params)), digest_of(raw));
}

TEST(SmoothSurface, GivesTheSameBytesEveryTime) {
  const LabelVolume heart = test::heart_volume(30, 24, 26);
  const SurfaceMesh raw = extract(heart);
  EXPECT_EQ(digest_of(smooth(raw, heart)), digest_of(smooth(raw, heart)));
}

TEST(SmoothSurface, GivesTheSameBytesOnEveryPlatform) {
  const LabelVolume noise = test::random_volume(12, 4, 11);
  const SurfaceMesh raw = extract(noise);
  EXPECT_EQ(digest_of(raw), "d37b8592e9cfb41a8f6b1c17ef3b857513e20cfac8a796c0600aef98f2a093df");
  EXPECT_EQ(digest_of(smooth(raw, noise)),
            "52b710c603a386c595a1f1908becdf057b073986c1bfeedb92b3a08c85c71e63");
}

TEST(SmoothSurface, KeepsNoisyVolumesClosedAndOutward) {
  for (int seed = 0; seed < 15; ++seed) {
    const LabelVolume noise = test::random_volume(12, 1 + seed % 5, static_cast<std::uint64_t>(500 + seed));
    ASSERT_TRUE(is_valid_surface(smooth(extract(noise), noise))) << seed;
  }
}

TEST(SmoothSurface, RejectsParametersOutOfRange) {
  const LabelVolume ball = test::ball_volume(10, 4.5, 3);
  const SurfaceMesh raw = extract(ball);
  RunContext ctx;
  const auto code_of = [&](const SurfaceMesh& surface, int iterations, double step, double reach) {
    SmoothParams params;
    params.iterations = iterations;
    params.step = step;
    params.max_move_voxels = reach;
    const Result<SurfaceMesh> result = smooth_surface(surface, ball, params, ctx);
    EXPECT_FALSE(result.ok());
    return result.ok() ? ErrorCode::kInternal : result.error().code;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code_of(raw, -1, 0.4, 0.5), ErrorCode::kUsage);
  EXPECT_EQ(code_of(raw, 50, 0.5, 0.5), ErrorCode::kUsage);
  EXPECT_EQ(code_of(raw, 50, 0, 0.5), ErrorCode::kUsage);
  EXPECT_EQ(code_of(raw, 50, nan, 0.5), ErrorCode::kUsage);
  EXPECT_EQ(code_of(raw, 50, 0.4, 0), ErrorCode::kUsage);
  EXPECT_EQ(code_of(raw, 50, 0.4, nan), ErrorCode::kUsage);
  EXPECT_EQ(code_of(SurfaceMesh{}, 50, 0.4, 0.5), ErrorCode::kBadInput);
  SurfaceMesh broken = raw;
  broken.triangles[3][1] = static_cast<std::uint32_t>(raw.points.size());
  EXPECT_EQ(code_of(broken, 50, 0.4, 0.5), ErrorCode::kBadInput);
  broken = raw;
  broken.sides.assign(raw.sides.size(), {2, 1});
  EXPECT_EQ(code_of(broken, 50, 0.4, 0.5), ErrorCode::kBadInput);
}

TEST(SmoothSurface, ReportsProgressAndHonoursCancel) {
  const LabelVolume ball = test::ball_volume(16, 7.5, 6);
  const SurfaceMesh raw = extract(ball);
  RunContext ctx;
  std::vector<double> fractions;
  ctx.on_progress = [&](const std::string&, double fraction) { fractions.push_back(fraction); };
  ASSERT_TRUE(smooth_surface(raw, ball, {}, ctx).ok());
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_DOUBLE_EQ(fractions.back(), 1.0);
  int asked = 0;
  ctx.on_cancelled = [&] { return ++asked > 5; };
  const Result<SurfaceMesh> stopped = smooth_surface(raw, ball, {}, ctx);
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().code, ErrorCode::kCancelled);
  EXPECT_EQ(asked, 6);
}

}  // namespace
}  // namespace voxtet
